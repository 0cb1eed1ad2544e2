#pragma once

#include <cstdint>
#include <span>

#include "explore/floor/dense_grid.hpp"
#include "robot/planner/way.hpp"

namespace lapwing::robot {

/// The part of its map, which has no end, that a robot plans in: a rectangle of whole tiles around its start, larger
/// where more was seen. Plans are made on dense grids, whose lowest cell is the rectangle's.
class PlanningArea {
 public:
  explicit PlanningArea(double cell_m);

  /// So that all of these are in it, and a tile beyond on the sides where one was not. Returns whether it has grown; it
  /// does not beyond `most_cells`.
  bool grow(std::span<map::TileKey const> seen);
  /// Sixteen million: at 5 cm a square of 200 m, for which plans take a gigabyte.
  static constexpr std::int64_t most_cells = std::int64_t{1} << 24;
  /// Something was seen beyond what it grows to.
  [[nodiscard]] bool is_cut_off() const { return is_cut_off_; }

  [[nodiscard]] int width() const { return (high_.x - low_.x + 1) * map::tile_cells; }   ///< in cells
  [[nodiscard]] int height() const { return (high_.y - low_.y + 1) * map::tile_cells; }  ///< in cells

  [[nodiscard]] bool contains(map::TileKey tile) const;
  /// Precondition: it is in the area.
  [[nodiscard]] explore::Cell lowest_cell_of(map::TileKey tile) const;
  /// From the map to the frame of the dense grids, and back.
  [[nodiscard]] explore::Place on_floor(Place const& place) const;
  [[nodiscard]] Place on_map(explore::Place const& place) const;

 private:
  bool take_in(map::TileKey tile);

  double cell_m_;
  // Both are in it.
  map::TileKey low_;
  map::TileKey high_;
  bool is_cut_off_ = false;
};

}  // namespace lapwing::robot
