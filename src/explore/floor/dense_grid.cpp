#include "explore/floor/dense_grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace lapwing::explore {

std::vector<Cell> cells_within(double distance_m, double cell_m) {
  int const reach = static_cast<int>(std::ceil(distance_m / cell_m)) + 1;
  std::vector<Cell> cells;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (x == 0 && y == 0) continue;
      double const gap_m = cell_m * std::hypot(std::max(std::abs(x) - 1, 0), std::max(std::abs(y) - 1, 0));
      // Distances that are equal but for the last digit of the cell's size count as reached.
      if (gap_m < distance_m - 1e-6) cells.push_back({x, y});
    }
  }
  return cells;
}

}  // namespace lapwing::explore
