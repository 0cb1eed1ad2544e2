#pragma once

#include "explore/floor/dense_grid.hpp"
#include "map/grid/cell_line.hpp"

namespace lapwing::explore {

using map::walk_line;

/// Every cell on the straight line between the middles of two fulfils `is_clear`; where it passes a corner exactly, one
/// of the two cells beside is asked.
template <class IsClear>
[[nodiscard]] bool is_line_clear(Cell from, Cell to, IsClear const& is_clear) {
  double const length = length_of(to - from);
  if (length == 0.0) return is_clear(from);
  bool is_all_clear = true;
  walk_line(from.x + 0.5, from.y + 0.5, (to.x - from.x) / length, (to.y - from.y) / length, length,
            [&](Cell cell, double) { return is_all_clear = is_clear(cell); });
  return is_all_clear;
}

}  // namespace lapwing::explore
