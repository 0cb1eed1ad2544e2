#include "map/grid/occupancy_grid.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "base/assert.hpp"

namespace lapwing::map {

namespace {

constexpr double steps_a_unit = 256.0;

/// Which cell of its tile.
std::size_t index_of(Cell cell) {
  constexpr std::int32_t mask = tile_cells - 1;
  return static_cast<std::size_t>(cell.y & mask) * tile_cells + static_cast<std::size_t>(cell.x & mask);
}

/// Of all that evidence can be, as whole maps are asked for it: an exponential a cell would be a good part of the work.
std::vector<double> probabilities() {
  std::vector<double> table;
  for (int steps = -Evidence::most_steps; steps <= Evidence::most_steps; ++steps)
    table.push_back(1.0 / (1.0 + std::exp(-Evidence::of_steps(steps).log_odds())));
  return table;
}

}  // namespace

Evidence Evidence::of_log_odds(double log_odds) {
  static_assert(most_steps == most_log_odds * steps_a_unit);
  return of_steps(static_cast<int>(std::lround(std::clamp(log_odds, -most_log_odds, most_log_odds) * steps_a_unit)));
}

Evidence Evidence::of_probability(double probability) {
  return of_log_odds(std::log(probability / (1.0 - probability)));  // infinite for what is sure, which is clamped
}

double Evidence::log_odds() const {
  return is_seen() ? steps_ / steps_a_unit : 0.0;
}

double Evidence::probability() const {
  static auto const table = probabilities();
  int const place = steps_ + most_steps;
  return is_seen() ? table[static_cast<std::size_t>(place)] : 0.5;
}

Evidence Evidence::and_also(Evidence other) const {
  if (!is_seen()) return other;
  if (!other.is_seen()) return *this;
  return of_steps(std::clamp(steps_ + other.steps_, -most_steps, most_steps));
}

OccupancyGrid::OccupancyGrid(double resolution_m, geo::Transform<geo::SiteFrame, GridFrame> site_from_grid)
    : resolution_m_(resolution_m), site_from_grid_(site_from_grid) {
  LAPWING_ASSERT(resolution_m >= 0.001 && resolution_m <= 100.0, resolution_m);
}

Cell OccupancyGrid::cell_at(geo::Point<GridFrame> const& point) const {
  return {static_cast<std::int32_t>(std::floor(point.x() / resolution_m_)),
          static_cast<std::int32_t>(std::floor(point.y() / resolution_m_))};
}

geo::Point<GridFrame> OccupancyGrid::centre_of(Cell cell) const {
  return {(cell.x + 0.5) * resolution_m_, (cell.y + 0.5) * resolution_m_};
}

Evidence OccupancyGrid::at(Cell cell) const {
  auto const tile = tiles_.find(tile_of(cell));
  return tile == tiles_.end() ? Evidence() : tile->second->cells[index_of(cell)];
}

void OccupancyGrid::set(Cell cell, Evidence evidence) {
  if (!evidence.is_seen() && !tiles_.contains(tile_of(cell))) return;
  tile_to_write(tile_of(cell)).cells[index_of(cell)] = evidence;
}

void OccupancyGrid::set_tile(TileKey key, std::shared_ptr<GridTile const> tile) {
  if (tile)
    tiles_.insert_or_assign(key, std::move(tile));
  else
    tiles_.erase(key);
}

GridTile& OccupancyGrid::tile_to_write(TileKey key) {
  auto& tile = tiles_[key];
  if (!tile) {
    tile = std::make_shared<GridTile>();
  } else if (tile.use_count() != 1) {
    tile = std::make_shared<GridTile>(*tile);
  }
  // Another thread may have let go of its snapshot just now: what it read comes before what is written here.
  std::atomic_thread_fence(std::memory_order_acquire);
  return const_cast<GridTile&>(*tile);  // every tile is made above, or by who gave it away, and nobody else has it
}

std::optional<geo::Box<GridFrame>> OccupancyGrid::extent() const {
  if (tiles_.empty()) return std::nullopt;
  auto least = tiles_.begin()->first;
  auto most = least;
  for (auto const& [key, tile] : tiles_) {
    least = {std::min(least.x, key.x), std::min(least.y, key.y)};
    most = {std::max(most.x, key.x), std::max(most.y, key.y)};
  }
  double const side_m = tile_cells * resolution_m_;
  return geo::Box<GridFrame>{{least.x * side_m, least.y * side_m}, {(most.x + 1) * side_m, (most.y + 1) * side_m}};
}

}  // namespace lapwing::map
