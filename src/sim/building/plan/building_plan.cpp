#include "sim/building/plan/building_plan.hpp"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

namespace lapwing::sim::building {

namespace {

bool is_free(map::Evidence evidence) {
  return evidence.is_seen() && evidence.probability() < 0.5;
}

/// One side of a free cell behind which it is solid. Sorted, neighbours on one line stand beside each other.
struct CellSide {
  enum class Of : std::uint8_t { low, high, left, right };
  Of of;
  std::int32_t line;   ///< y of a level one, x of an upright one, in cells
  std::int32_t along;  ///< where it begins
  friend auto operator<=>(CellSide const&, CellSide const&) = default;
};

std::vector<CellSide> solid_sides(map::OccupancyGrid const& grid) {
  std::vector<CellSide> sides;
  for (auto const& [key, tile] : grid.tiles()) {
    auto const is_free_at = [&](std::int32_t x, std::int32_t y) {
      if (x >= 0 && y >= 0 && x < map::tile_cells && y < map::tile_cells)
        return is_free(tile->cells[static_cast<std::size_t>(y) * map::tile_cells + static_cast<std::size_t>(x)]);
      return is_free(grid.at({key.x * map::tile_cells + x, key.y * map::tile_cells + y}));
    };
    for (std::int32_t y = 0; y < map::tile_cells; ++y) {
      for (std::int32_t x = 0; x < map::tile_cells; ++x) {
        if (!is_free_at(x, y)) continue;
        std::int32_t const column = key.x * map::tile_cells + x;
        std::int32_t const row = key.y * map::tile_cells + y;
        if (!is_free_at(x, y - 1)) sides.push_back({CellSide::Of::low, row, column});
        if (!is_free_at(x, y + 1)) sides.push_back({CellSide::Of::high, row + 1, column});
        if (!is_free_at(x - 1, y)) sides.push_back({CellSide::Of::left, column, row});
        if (!is_free_at(x + 1, y)) sides.push_back({CellSide::Of::right, column + 1, row});
      }
    }
  }
  std::ranges::sort(sides);
  return sides;
}

/// Solid on the left.
BorderPlan border_of(CellSide const& first, std::int32_t end, double cell_m) {
  double const line_m = first.line * cell_m;
  double const begin_m = first.along * cell_m;
  double const end_m = end * cell_m;
  switch (first.of) {
    case CellSide::Of::low: return {Place(end_m, line_m), Place(begin_m, line_m)};
    case CellSide::Of::high: return {Place(begin_m, line_m), Place(end_m, line_m)};
    case CellSide::Of::left: return {Place(line_m, begin_m), Place(line_m, end_m)};
    case CellSide::Of::right: return {Place(line_m, end_m), Place(line_m, begin_m)};
  }
  return {};
}

}  // namespace

std::optional<geo::Box<geo::FloorFrame>> extent_of(BuildingPlan const& plan) {
  std::optional<geo::Box<geo::FloorFrame>> extent;
  auto const add = [&](Place const& place, double around_m) {
    Shift const margin(around_m, around_m);
    if (!extent) extent = {place, place};
    extent->least.v = extent->least.v.cwiseMin((place - margin).v);
    extent->most.v = extent->most.v.cwiseMax((place + margin).v);
  };
  for (auto const& wall : plan.walls) {
    add(wall.from, wall.thickness_m / 2.0);
    add(wall.to, wall.thickness_m / 2.0);
  }
  for (auto const& border : plan.borders) {
    add(border.from, 0.0);
    add(border.to, 0.0);
  }
  for (auto const& block : plan.furniture) add(block.middle.position, std::hypot(block.length_m, block.width_m) / 2.0);
  return extent;
}

base::Result<BuildingPlan> plan_of_map(map::OccupancyGrid const& grid, std::string name) {
  auto const cells = static_cast<std::int64_t>(grid.tiles().size()) * map::tile_cells * map::tile_cells;
  if (cells > most_map_cells)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("the map has {} cells, more than {}", cells, most_map_cells),
                      "cut the map, or draw it with larger cells");
  auto const sides = solid_sides(grid);
  if (sides.empty())
    return base::fail(base::ErrorKind::invalid_input, "the map has no free cell",
                      "check `negate`, `free_thresh` and `occupied_thresh` of its .yaml against the picture");
  BuildingPlan plan;
  plan.name = std::move(name);
  plan.site_from_floor = {grid.site_from_grid() * geo::Point<map::GridFrame>(0.0, 0.0),
                          grid.site_from_grid().yaw_rad()};
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t j = i + 1;
    while (j < sides.size() && sides[j].of == sides[i].of && sides[j].line == sides[i].line &&
           sides[j].along == sides[j - 1].along + 1)
      ++j;
    plan.borders.push_back(border_of(sides[i], sides[j - 1].along + 1, grid.resolution_m()));
    i = j;
  }
  return plan;
}

}  // namespace lapwing::sim::building
