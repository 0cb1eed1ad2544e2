#include "explore/simulated/world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "explore/floor/flood.hpp"
#include "explore/floor/ray.hpp"

namespace lapwing::explore {

namespace {

using Mask = DenseGrid<std::uint8_t>;

int cells_a_side(double fine_m, Settings const& settings) {
  return std::max(1, static_cast<int>(std::floor(settings.map_cell_m / fine_m + 1e-9)));
}

/// A coarse cell is free when all of it is.
Mask coarse_of(Mask const& fine, int parts) {
  Mask coarse(fine.width() / parts, fine.height() / parts, 1);
  for (int y = 0; y < coarse.height() * parts; ++y) {
    for (int x = 0; x < coarse.width() * parts; ++x) {
      if (fine[{x, y}] == 0) coarse[{x / parts, y / parts}] = 0;
    }
  }
  return coarse;
}

/// Where all cells within `keep_off` are free.
Mask with_room(Mask const& is_free, std::vector<Cell> const& keep_off) {
  Mask room = is_free;
  for (int y = 0; y < is_free.height(); ++y) {
    for (int x = 0; x < is_free.width(); ++x) {
      if (is_free[{x, y}] == 0) continue;
      room[{x, y}] =
          std::ranges::all_of(keep_off, [&](Cell away) { return is_free.or_else(Cell{x, y} + away, 0) != 0; });
    }
  }
  return room;
}

/// Free cells near a standable one are seen from there for sure; of the others each looks around.
class Sight {
 public:
  Sight(Mask const& is_free, Mask const& is_standable, double range_cells)
      : is_free_(is_free), is_standable_(is_standable), range_cells_(range_cells) {
    constexpr int directions = 96;
    for (int i = 0; i < directions; ++i) {
      double const yaw = (i + 0.5) * 2.0 * std::numbers::pi / directions;
      ways_.emplace_back(std::cos(yaw), std::sin(yaw));
    }
    // Most cells that nobody can stand on lie beside some that one can.
    std::ranges::sort(near_, {}, length_of);
  }

  [[nodiscard]] bool is_seen(Cell cell) const {
    for (auto const& away : near_) {
      if (is_standable_.or_else(cell + away, 0) == 0) continue;
      if (is_line_clear(cell, cell + away, [&](Cell at) { return is_free_.or_else(at, 0) != 0; })) return true;
    }
    for (auto const& way : ways_) {
      bool sees = false;
      walk_line(cell.x + 0.5, cell.y + 0.5, way.x(), way.y(), range_cells_, [&](Cell at, double) {
        if (is_free_.or_else(at, 0) == 0) return false;
        sees = is_standable_[at] != 0;
        return !sees;
      });
      if (sees) return true;
    }
    return false;
  }

 private:
  Mask const& is_free_;
  Mask const& is_standable_;
  double range_cells_;
  std::vector<Shift> ways_;
  std::vector<Cell> near_ = cells_within(6.0, 1.0);
};

Mask wanted_cells(Mask const& is_free, Mask const& is_standable, double range_cells) {
  Mask wanted(is_free.width(), is_free.height(), 0);
  Sight const sight(is_free, is_standable, range_cells);
  for (int y = 0; y < is_free.height(); ++y) {
    for (int x = 0; x < is_free.width(); ++x) {
      if (is_free[{x, y}] != 0) wanted[{x, y}] = is_standable[{x, y}] != 0 || sight.is_seen({x, y});
    }
  }
  return wanted;
}

struct Bounds {
  Cell least{std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::max()};
  Cell most{std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::min()};
  std::size_t cells = 0;

  void add(Cell cell) {
    least = {std::min(least.x, cell.x), std::min(least.y, cell.y)};
    most = {std::max(most.x, cell.x), std::max(most.y, cell.y)};
    ++cells;
  }
};

std::optional<Cell> nearest_standable(Mask const& standable, Cell around, int reach) {
  std::optional<Cell> best;
  double least = std::numeric_limits<double>::max();
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      double const far = std::hypot(x, y);
      if (far > reach || far >= least || standable.or_else(around + Cell{x, y}, 0) == 0) continue;
      best = around + Cell{x, y};
      least = far;
    }
  }
  return best;
}

}  // namespace

base::Result<World> World::around(FloorPlan const& plan, Place const& start, Settings const& settings) {
  auto const wrong = [&](std::string_view why) {
    auto const at = plan.site_from_floor * start;
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("the robot cannot start at {:.2f}, {:.2f}: {}", at.x(), at.y(), why),
                      "choose a free place of the map, in its metres, or leave --start out");
  };
  auto const start_cell = cell_under(start, plan.cell_m);
  if (!plan.is_free.contains(start_cell)) return wrong("that is outside of the floor plan");
  if (plan.is_free[start_cell] == 0) return wrong("there is a wall, or nothing is known of it");

  Mask reached(plan.is_free.width(), plan.is_free.height(), 0);
  Bounds bounds;
  flood(
      reached, start_cell, std::uint8_t{1}, 4, [&](Cell cell) { return plan.is_free[cell] != 0; },
      [&](Cell cell) { bounds.add(cell); });

  World world;
  int const parts = cells_a_side(plan.cell_m, settings);
  world.cells_a_side_ = parts;
  world.fine_m_ = plan.cell_m;
  Cell const corner{bounds.least.x - parts, bounds.least.y - parts};
  int const width = ((bounds.most.x - corner.x) / parts + 2) * parts;
  int const height = ((bounds.most.y - corner.y) / parts + 2) * parts;
  world.is_free_ = Mask(width, height, 0);
  for (int y = bounds.least.y; y <= bounds.most.y; ++y) {
    for (int x = bounds.least.x; x <= bounds.most.x; ++x) world.is_free_[Cell{x, y} - corner] = reached[{x, y}];
  }
  world.plan_from_world_ = Shift(corner.x * plan.cell_m, corner.y * plan.cell_m);
  world.site_from_floor_ = {plan.site_from_floor * (Place() + world.plan_from_world_), plan.site_from_floor.yaw_rad()};

  auto const own_start = start - world.plan_from_world_;
  if (!world.has_room(own_start, settings.carrier.radius_m)) return wrong("the robot would touch a wall");
  auto const is_free = coarse_of(world.is_free_, parts);
  double const cell_m = world.cell_m();
  auto const room =
      with_room(is_free, cells_within(settings.carrier.radius_m + settings.carrier.safe_distance_m, cell_m));
  auto const first = nearest_standable(room, cell_under(own_start, cell_m), static_cast<int>(std::ceil(0.5 / cell_m)));
  if (!first) return wrong("the robot has no room there");
  world.is_standable_ = Mask(is_free.width(), is_free.height(), 0);
  flood(world.is_standable_, *first, std::uint8_t{1}, 8, [&](Cell cell) { return room[cell] != 0; }, [](Cell) {});
  world.is_wanted_ = wanted_cells(is_free, world.is_standable_, settings.laser.range_m / cell_m);
  for (std::size_t i = 0; i < world.is_wanted_.size(); ++i) world.wanted_ += world.is_wanted_.at_index(i);
  return world;
}

double World::distance_to_wall_m(Place const& from, Shift const& way, double range_m) const {
  double distance_m = range_m;
  walk_line(from.x() / fine_m_, from.y() / fine_m_, way.x(), way.y(), range_m / fine_m_, [&](Cell cell, double at) {
    if (is_free_.or_else(cell, 0) != 0) return true;
    distance_m = at * fine_m_;
    return false;
  });
  return distance_m;
}

bool World::has_room(Place const& middle, double radius_m) const {
  auto const least = cell_under(middle - Shift(radius_m, radius_m), fine_m_);
  auto const most = cell_under(middle + Shift(radius_m, radius_m), fine_m_);
  for (int y = least.y; y <= most.y; ++y) {
    for (int x = least.x; x <= most.x; ++x) {
      if (is_free_.or_else({x, y}, 0) != 0) continue;
      double const near_x = std::clamp(middle.x(), x * fine_m_, (x + 1) * fine_m_);
      double const near_y = std::clamp(middle.y(), y * fine_m_, (y + 1) * fine_m_);
      if (std::hypot(near_x - middle.x(), near_y - middle.y()) < radius_m) return false;
    }
  }
  return true;
}

std::vector<Place> possible_starts(FloorPlan const& plan, Settings const& settings) {
  int const parts = cells_a_side(plan.cell_m, settings);
  double const cell_m = plan.cell_m * parts;
  auto const is_free = coarse_of(plan.is_free, parts);
  auto const keep_off = cells_within(settings.carrier.radius_m + settings.carrier.safe_distance_m, cell_m);
  auto const room = with_room(is_free, keep_off);
  DenseGrid<std::uint32_t> part_of(room.width(), room.height(), 0);
  std::vector<std::pair<std::size_t, bool>> parts_found = {{0, false}};
  int const edge = std::ranges::max(keep_off, {}, &Cell::x).x;
  for (std::size_t i = 0; i < room.size(); ++i) {
    if (room.at_index(i) == 0 || part_of.at_index(i) != 0) continue;
    std::pair<std::size_t, bool> found = {0, false};
    flood(
        part_of, room.cell_of(i), static_cast<std::uint32_t>(parts_found.size()), 8,
        [&](Cell cell) { return room[cell] != 0; },
        [&](Cell cell) {
          ++found.first;
          found.second = found.second || cell.x <= edge || cell.y <= edge || cell.x >= room.width() - 1 - edge ||
                         cell.y >= room.height() - 1 - edge;
        });
    parts_found.push_back(found);
  }
  std::size_t largest = 0;
  std::size_t largest_indoors = 0;
  for (std::size_t i = 1; i < parts_found.size(); ++i) {
    if (parts_found[i].first > parts_found[largest].first) largest = i;
    if (!parts_found[i].second && parts_found[i].first > parts_found[largest_indoors].first) largest_indoors = i;
  }
  // A closet within a floor whose walls are not drawn to the end is not what was meant.
  if (10 * parts_found[largest_indoors].first >= 3 * parts_found[largest].first) largest = largest_indoors;
  std::vector<Place> starts;
  for (std::size_t i = 0; largest != 0 && i < room.size(); ++i) {
    if (part_of.at_index(i) == largest) starts.push_back(middle_of(room.cell_of(i), cell_m));
  }
  return starts;
}

}  // namespace lapwing::explore
