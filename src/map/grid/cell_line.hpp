#pragma once

#include <cmath>
#include <limits>

#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

/// Visits the cells that a straight line passes, in order (Amanatides & Woo 1987), until `visit(cell, enters_at)` is
/// false or the line is `length` cells long; `enters_at` is how far along, in cells. The cell of the start comes first.
template <class Visit>
void walk_line(double x, double y, double direction_x, double direction_y, double length, Visit const& visit) {
  Cell cell{static_cast<std::int32_t>(std::floor(x)), static_cast<std::int32_t>(std::floor(y))};
  constexpr double never = std::numeric_limits<double>::infinity();
  int const step_x = direction_x > 0.0 ? 1 : -1;
  int const step_y = direction_y > 0.0 ? 1 : -1;
  double const a_cell_x = direction_x != 0.0 ? std::abs(1.0 / direction_x) : never;
  double const a_cell_y = direction_y != 0.0 ? std::abs(1.0 / direction_y) : never;
  double next_x = direction_x != 0.0 ? (direction_x > 0.0 ? cell.x + 1.0 - x : x - cell.x) * a_cell_x : never;
  double next_y = direction_y != 0.0 ? (direction_y > 0.0 ? cell.y + 1.0 - y : y - cell.y) * a_cell_y : never;
  double at = 0.0;
  while (visit(cell, at)) {
    if (next_x < next_y) {
      at = next_x;
      next_x += a_cell_x;
      cell.x += step_x;
    } else {
      at = next_y;
      next_y += a_cell_y;
      cell.y += step_y;
    }
    if (!(at < length)) return;
  }
}

}  // namespace lapwing::map
