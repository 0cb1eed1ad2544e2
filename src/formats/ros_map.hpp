#pragma once

#include <filesystem>
#include <string>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"

/// Occupancy grids as ROS map servers read and write them: `NAME.pgm` and `NAME.yaml` (nav2_map_server, map_io.cpp;
/// wiki.ros.org/map_server).
namespace lapwing::formats {

struct RosMapOptions {
  /// Probabilities from here on are written as taken, and those up to `free_threshold` as free, in mode `trinary`.
  double taken_threshold = 0.65;
  double free_threshold = 0.196;
  /// `raw`: percent as the picture's values, with nothing rounded to three words; Nav2 reads both.
  bool is_raw = false;
};

/// Writes `FOLDER/NAME.pgm` and `FOLDER/NAME.yaml`. Errors: invalid_input for an empty grid; io.
[[nodiscard]] base::Result<> write_ros_map(map::OccupancyGrid const& grid, std::filesystem::path const& folder,
                                           std::string const& name, RosMapOptions const& options = {});

/// Reads the .yaml and the picture that it names, which lies beside it: PGM, PNG and what else GDAL takes for a
/// picture, in the modes `trinary`, `scale` and `raw`. Errors, invalid_input: what is not such a map, and more than
/// 400 million cells; io.
[[nodiscard]] base::Result<map::OccupancyGrid> read_ros_map(std::filesystem::path const& yaml);

}  // namespace lapwing::formats
