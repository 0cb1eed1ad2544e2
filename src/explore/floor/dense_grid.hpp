#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geo/point.hpp"
#include "geo/transform.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::explore {

using map::Cell;

/// Frame of the floor that is explored: metres, x to the right, y up, origin in the lower left corner of its grids.
struct FloorFrame {};
using Place = geo::Point<FloorFrame>;
using Shift = geo::Vector<FloorFrame>;
using Pose = geo::Pose<FloorFrame>;

/// Cells from (0, 0) to (width - 1, height - 1) in one piece, row by row from the lowest.
template <class T>
class DenseGrid {
 public:
  DenseGrid() = default;
  DenseGrid(int width, int height, T value = {})
      : width_(width),
        height_(height),
        cells_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  [[nodiscard]] bool contains(Cell cell) const {
    return static_cast<unsigned>(cell.x) < static_cast<unsigned>(width_) &&
           static_cast<unsigned>(cell.y) < static_cast<unsigned>(height_);
  }
  [[nodiscard]] std::size_t index_of(Cell cell) const {
    return static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(cell.x);
  }
  [[nodiscard]] Cell cell_of(std::size_t index) const {
    auto const width = static_cast<std::size_t>(width_);
    return {static_cast<std::int32_t>(index % width), static_cast<std::int32_t>(index / width)};
  }
  /// Precondition of both: it is there.
  [[nodiscard]] T const& operator[](Cell cell) const { return cells_[index_of(cell)]; }
  [[nodiscard]] T& operator[](Cell cell) { return cells_[index_of(cell)]; }
  [[nodiscard]] T const& at_index(std::size_t index) const { return cells_[index]; }
  [[nodiscard]] T& at_index(std::size_t index) { return cells_[index]; }
  /// What stands beyond the edge is `beyond`.
  [[nodiscard]] T or_else(Cell cell, T beyond) const { return contains(cell) ? cells_[index_of(cell)] : beyond; }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<T> cells_;
};

[[nodiscard]] inline Cell cell_under(Place const& place, double cell_m) {
  return {static_cast<std::int32_t>(std::floor(place.x() / cell_m)),
          static_cast<std::int32_t>(std::floor(place.y() / cell_m))};
}

[[nodiscard]] inline Place middle_of(Cell cell, double cell_m) {
  return {(cell.x + 0.5) * cell_m, (cell.y + 0.5) * cell_m};
}

/// To the right, up, left, down, and then the diagonal ones.
inline constexpr std::array<Cell, 8> neighbours = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

[[nodiscard]] constexpr Cell operator+(Cell a, Cell b) {
  return {a.x + b.x, a.y + b.y};
}
[[nodiscard]] constexpr Cell operator-(Cell a, Cell b) {
  return {a.x - b.x, a.y - b.y};
}

/// In cells. No grid is so large that its square overflows, against which std::hypot would guard at several times the
/// cost.
[[nodiscard]] inline double length_of(Cell way) {
  auto const x = static_cast<double>(way.x);
  auto const y = static_cast<double>(way.y);
  return std::sqrt(x * x + y * y);
}

/// The cells whose area comes nearer to that of cell (0, 0) than `distance_m`, without itself.
[[nodiscard]] std::vector<Cell> cells_within(double distance_m, double cell_m);

}  // namespace lapwing::explore
