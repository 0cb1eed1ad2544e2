#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "autonomy/operator/occupancy_map.hpp"
#include "base/error.hpp"

namespace lapwing::autonomy {

/// What heartbeats and maps have of it: Columns, Rows and so on.
[[nodiscard]] nlohmann::ordered_json map_json(OccupancyMap const& map);

/// The map with its number, for operators that have asked to be told of changes alone. Error (invalid_input): it is not
/// sound.
[[nodiscard]] base::Result<std::string> map_text(OccupancyMap const& map, std::uint64_t revision);

/// What is another one in `now` than in `before`, which has the number `since`: runs of cells, each with the number of
/// its first. Precondition: they are alike, and sound. With all that may change at once it fits into one message.
[[nodiscard]] std::string map_changes_text(OccupancyMap const& before, std::uint64_t since, OccupancyMap const& now,
                                           std::uint64_t revision);

}  // namespace lapwing::autonomy
