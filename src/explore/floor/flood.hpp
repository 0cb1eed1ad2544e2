#pragma once

#include <vector>

#include "explore/floor/dense_grid.hpp"

namespace lapwing::explore {

/// Visits every cell with `is_open(cell)` that is connected with `from`, that one first. `reached` must be 0 wherever
/// nothing was reached before, and gets `mark`. With `directions` 4 diagonal neighbours do not touch, with 8 they do.
template <class T, class IsOpen, class Visit>
void flood(DenseGrid<T>& reached, Cell from, T mark, int directions, IsOpen const& is_open, Visit const& visit) {
  if (!reached.contains(from) || reached[from] != T{} || !is_open(from)) return;
  std::vector<Cell> open = {from};
  reached[from] = mark;
  while (!open.empty()) {
    auto const cell = open.back();
    open.pop_back();
    visit(cell);
    for (int i = 0; i < directions; ++i) {
      auto const next = cell + neighbours[static_cast<std::size_t>(i)];
      if (!reached.contains(next) || reached[next] != T{} || !is_open(next)) continue;
      reached[next] = mark;
      open.push_back(next);
    }
  }
}

}  // namespace lapwing::explore
