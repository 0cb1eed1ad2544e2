#include "explore/floor/floor_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lapwing::explore {

namespace {

constexpr double coarsest_m = 0.1;

bool is_free(map::Evidence evidence) {
  return evidence.is_seen() && evidence.probability() < 0.5;
}

struct Bounds {
  std::int64_t left = std::numeric_limits<std::int64_t>::max();
  std::int64_t low = std::numeric_limits<std::int64_t>::max();
  std::int64_t right = std::numeric_limits<std::int64_t>::min();
  std::int64_t high = std::numeric_limits<std::int64_t>::min();
  bool has_free = false;
};

template <class Visit>
void each_seen_cell(map::OccupancyGrid const& grid, Visit const& visit) {
  for (auto const& [key, tile] : grid.tiles()) {
    for (std::int32_t i = 0; i < map::tile_cells * map::tile_cells; ++i) {
      auto const evidence = tile->cells[static_cast<std::size_t>(i)];
      if (evidence.is_seen())
        visit(std::int64_t{key.x} * map::tile_cells + i % map::tile_cells,
              std::int64_t{key.y} * map::tile_cells + i / map::tile_cells, is_free(evidence));
    }
  }
}

Bounds seen_bounds(map::OccupancyGrid const& grid) {
  Bounds bounds;
  each_seen_cell(grid, [&](std::int64_t x, std::int64_t y, bool is_free_cell) {
    bounds.has_free = bounds.has_free || is_free_cell;
    bounds.left = std::min(bounds.left, x);
    bounds.low = std::min(bounds.low, y);
    bounds.right = std::max(bounds.right, x);
    bounds.high = std::max(bounds.high, y);
  });
  return bounds;
}

}  // namespace

base::Result<FloorPlan> floor_plan_of(map::OccupancyGrid const& grid) {
  auto const bounds = seen_bounds(grid);
  if (!bounds.has_free)
    return base::fail(base::ErrorKind::invalid_input, "the floor plan has no free cell",
                      "check `negate`, `free_thresh` and `occupied_thresh` of its .yaml against the picture");
  double const whole_m = grid.resolution_m();
  auto const parts = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(whole_m / coarsest_m - 1e-9)));
  std::int64_t const width = (bounds.right - bounds.left + 1) * parts;
  std::int64_t const height = (bounds.high - bounds.low + 1) * parts;
  if (width > most_floor_cells || height > most_floor_cells || width * height > most_floor_cells)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("the floor plan is {} x {} cells, more than 64 million", width, height),
                      "cut the plan, or draw it with larger cells");
  FloorPlan plan;
  plan.cell_m = whole_m / static_cast<double>(parts);
  plan.is_free = DenseGrid<std::uint8_t>(static_cast<int>(width), static_cast<int>(height), 0);
  each_seen_cell(grid, [&](std::int64_t x, std::int64_t y, bool is_free_cell) {
    if (!is_free_cell) return;
    auto const left = static_cast<std::int32_t>((x - bounds.left) * parts);
    auto const low = static_cast<std::int32_t>((y - bounds.low) * parts);
    for (std::int32_t dy = 0; dy < parts; ++dy) {
      for (std::int32_t dx = 0; dx < parts; ++dx) plan.is_free[{left + dx, low + dy}] = 1;
    }
  });
  auto const corner = grid.site_from_grid() * geo::Point<map::GridFrame>(static_cast<double>(bounds.left) * whole_m,
                                                                         static_cast<double>(bounds.low) * whole_m);
  plan.site_from_floor = {corner, grid.site_from_grid().yaw_rad()};
  return plan;
}

}  // namespace lapwing::explore
