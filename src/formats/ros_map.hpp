#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "map/grid/ros_map.hpp"

/// Occupancy grids as ROS map servers read and write them: `NAME.pgm` and `NAME.yaml` (map/grid/ros_map.hpp).
namespace lapwing::formats {

/// Writes `FOLDER/NAME.pgm` and `FOLDER/NAME.yaml`. Errors: invalid_input for an empty grid; io.
[[nodiscard]] base::Result<> write_ros_map(map::OccupancyGrid const& grid, std::filesystem::path const& folder,
                                           std::string const& name, map::RosMapOptions const& options = {});

/// Reads the .yaml and the picture that it names, which lies beside it: PGM, PNG and what else GDAL takes for a
/// picture, in the modes `trinary`, `scale` and `raw`. Errors, invalid_input: what is not such a map, and more than
/// 400 million cells; io.
[[nodiscard]] base::Result<map::OccupancyGrid> read_ros_map(std::filesystem::path const& yaml);

}  // namespace lapwing::formats
