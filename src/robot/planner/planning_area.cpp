#include "robot/planner/planning_area.hpp"

namespace lapwing::robot {

namespace {

constexpr std::int32_t first_tiles = 2;  ///< to each side of the start: 26 m at 5 cm, a usual floor

constexpr std::int32_t beyond_tiles = 1;  ///< so that it does not grow with every step

}  // namespace

PlanningArea::PlanningArea(double cell_m)
    : cell_m_(cell_m), low_{-first_tiles, -first_tiles}, high_{first_tiles - 1, first_tiles - 1} {}

bool PlanningArea::grow(std::span<map::TileKey const> seen) {
  bool has_grown = false;
  for (auto const tile : seen) has_grown |= take_in(tile);
  return has_grown;
}

bool PlanningArea::contains(map::TileKey tile) const {
  return tile.x >= low_.x && tile.x <= high_.x && tile.y >= low_.y && tile.y <= high_.y;
}

bool PlanningArea::take_in(map::TileKey tile) {
  if (contains(tile)) return false;
  auto low = low_;
  auto high = high_;
  if (tile.x < low.x) low.x = tile.x - beyond_tiles;
  if (tile.y < low.y) low.y = tile.y - beyond_tiles;
  if (tile.x > high.x) high.x = tile.x + beyond_tiles;
  if (tile.y > high.y) high.y = tile.y + beyond_tiles;
  constexpr std::int64_t most_tiles = most_cells / (std::int64_t{map::tile_cells} * map::tile_cells);
  auto const across = std::int64_t{high.x} - low.x + 1;
  auto const up = std::int64_t{high.y} - low.y + 1;
  if (across > most_tiles || up > most_tiles || across * up > most_tiles) {
    is_cut_off_ = true;
    return false;
  }
  low_ = low;
  high_ = high;
  return true;
}

explore::Cell PlanningArea::lowest_cell_of(map::TileKey tile) const {
  return {(tile.x - low_.x) * map::tile_cells, (tile.y - low_.y) * map::tile_cells};
}

explore::Place PlanningArea::on_floor(Place const& place) const {
  double const tile_m = map::tile_cells * cell_m_;
  return {place.x() - low_.x * tile_m, place.y() - low_.y * tile_m};
}

Place PlanningArea::on_map(explore::Place const& place) const {
  double const tile_m = map::tile_cells * cell_m_;
  return {place.x() + low_.x * tile_m, place.y() + low_.y * tile_m};
}

}  // namespace lapwing::robot
