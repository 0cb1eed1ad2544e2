#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "vision/lot/evaluate_slots.hpp"

namespace lapwing::apps::detect {

/// The slots of a picture as a file has them: `{"slots": [{"corners": [[x, y], ...4], "occupied": true}]}`, pixels of
/// the upright picture, `occupied` left out or null where it is not known. None if there is no such file.
[[nodiscard]] base::Result<std::optional<std::vector<vision::JudgedSlot>>> slots_of_file(
    std::filesystem::path const& file);

}  // namespace lapwing::apps::detect
