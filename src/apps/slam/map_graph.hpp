#pragma once

#include <filesystem>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::apps {

/// Whether the text is a pose graph in the format of g2o.
[[nodiscard]] bool is_pose_graph(std::string_view text);

/// The poses that agree best with a pose graph's constraints, as `graph.g2o` and `report.json` in that folder.
[[nodiscard]] base::Result<> settle_graph(std::string_view text, std::filesystem::path const& out);

}  // namespace lapwing::apps
