#pragma once

#include <string>
#include <string_view>

#include "map/grid/cell_box.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

struct RosMapOptions {
  /// Cells that are likelier taken than this are written as taken, and those below `free_below` as free, in mode
  /// `trinary`; what is between is as unknown as what was never seen.
  double taken_above = 0.65;
  double free_below = 0.25;
  /// `raw`: percent as the picture's values, with nothing rounded to three words; Nav2 reads both.
  bool is_raw = false;
};

/// An occupancy grid as ROS map servers read it (nav2_map_server, map_io.cpp; wiki.ros.org/map_server).
struct RosMap {
  std::string pgm;   ///< 0 taken, 254 free, 205 unknown, rows from above
  std::string yaml;  ///< names the picture NAME.pgm
};

/// The cells of `box`, which is where the picture ends.
[[nodiscard]] RosMap ros_map(OccupancyGrid const& grid, CellBox const& box, std::string_view name,
                             RosMapOptions const& options = {});

}  // namespace lapwing::map
