#pragma once

#include <filesystem>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::apps {

/// Writes FOLDER/map.pgm and map.yaml for ROS, and map.png, all without the unknown around what was seen.
/// Precondition: something was seen.
[[nodiscard]] base::Result<> write_map(map::OccupancyGrid const& grid, std::filesystem::path const& folder);

}  // namespace lapwing::apps
