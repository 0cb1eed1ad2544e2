#pragma once

#include <filesystem>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::apps {

/// A grid's cells in one rectangle, row by row from the top: grey as ROS's map_server has it in mode "trinary" (0
/// taken, 254 free, 205 unknown).
struct GridPicture {
  int width = 0;
  int height = 0;
  double cell_m = 0.0;
  double left_m = 0.0;  ///< of the lower left corner
  double bottom_m = 0.0;
  std::string grey = {};
};
/// Without the unknown around it. Precondition: something was seen.
[[nodiscard]] GridPicture picture_of(map::OccupancyGrid const& grid);

/// Writes FOLDER/map.pgm, map.yaml and map.png.
[[nodiscard]] base::Result<> write_map(GridPicture const& picture, std::filesystem::path const& folder);

}  // namespace lapwing::apps
