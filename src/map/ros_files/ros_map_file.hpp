#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

/// A picture of a floor, row by row from above, grey from 0 black to 255 white.
struct MapPicture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
  std::vector<std::uint8_t> alpha;  ///< empty: none
};

/// Reads pictures that are no PGM; who has no library for them says so.
using ReadPicture = std::function<base::Result<MapPicture>(std::filesystem::path const& path)>;

/// Reads a map as ROS map servers do: the .yaml, in the modes `trinary`, `scale` and `raw`, and the picture that it
/// names, which lies beside it. Errors, invalid_input: what is not such a map, and more than 400 million cells; io;
/// those of `read_other`.
[[nodiscard]] base::Result<OccupancyGrid> read_ros_map(std::filesystem::path const& yaml,
                                                       ReadPicture const& read_other);

}  // namespace lapwing::map
