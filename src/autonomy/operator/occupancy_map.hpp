#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "autonomy/interface/command.hpp"
#include "geo/point.hpp"

namespace lapwing::autonomy {

/// The occupancy map as ROS has it (nav_msgs/OccupancyGrid): row by row from the lower left corner, -1 unknown, else
/// percent.
struct OccupancyMap {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double resolution_m = 0.0;
  geo::Point<ArmingFrame> origin = {};  ///< of the lower left corner
  std::vector<std::int8_t> cells = {};
};

/// As large as one message of the operator link carries with every cell at its longest.
inline constexpr std::size_t most_map_cells = 200'000;

/// Whether it has as many cells as it says, and no more than may be.
[[nodiscard]] inline bool is_sound(OccupancyMap const& map) {
  auto const cells = std::uint64_t{map.columns} * map.rows;
  return cells == map.cells.size() && cells <= most_map_cells;
}
/// Whether a cell of one is the same ground in the other.
[[nodiscard]] inline bool is_alike(OccupancyMap const& a, OccupancyMap const& b) {
  return a.columns == b.columns && a.rows == b.rows && a.resolution_m == b.resolution_m && a.origin == b.origin;
}

}  // namespace lapwing::autonomy
