#include "explore/known/known_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "explore/floor/ray.hpp"

namespace lapwing::explore {

namespace {

constexpr std::int8_t least_odds = -8;
constexpr std::int8_t most_odds = 12;
/// Surfaces of floor plans lie on the borders of cells: a beam's end is taken this share of a cell farther, so that
/// noise does not draw it into the cell before.
constexpr double into_the_wall = 0.4;
/// Who walks stands still for less than this; what is there after it is a wall.
constexpr double sure_after_s = 4.0;
/// Where the floor was free before, it takes longer to believe in a wall.
constexpr double sure_where_free_s = 60.0;
constexpr int often_free = -4;
/// So many ends of one scan where the floor had been free are no noise.
constexpr int ends_of_movement = 2;

}  // namespace

Knowledge knowledge_of(map::Evidence evidence) {
  if (!evidence.is_seen()) return Knowledge::unknown;
  return evidence.probability() < 0.5 ? Knowledge::free : Knowledge::wall;
}

std::vector<Shift> beam_ways(double yaw_rad, std::size_t beams) {
  std::vector<Shift> ways;
  ways.reserve(beams);
  // Each is the one before, turned by the same angle: a sine and a cosine a beam would cost as much as the beam.
  double const step = 2.0 * std::numbers::pi / static_cast<double>(beams);
  double const cos_step = std::cos(step);
  double const sin_step = std::sin(step);
  Shift way(std::cos(yaw_rad), std::sin(yaw_rad));
  for (std::size_t i = 0; i < beams; ++i) {
    ways.push_back(way);
    way = Shift(cos_step * way.x() - sin_step * way.y(), sin_step * way.x() + cos_step * way.y());
  }
  return ways;
}

KnownMap::KnownMap(int width, int height, double cell_m, Distances distances)
    : cell_m_(cell_m),
      keep_off_m_(distances.keep_off_m),
      state_(width, height, Knowledge::unknown),
      odds_(width, height, 0),
      walls_near_(width, height, 0),
      driven_(width, height, 0),
      hit_by_(width, height, 0),
      wall_since_s_(width, height, 0.0F),
      is_sure_(width, height, 0),
      was_free_(width, height, 0),
      frontier_place_(width, height, 0),
      keep_off_(cells_within(distances.keep_off_m, cell_m)),
      wary_(cells_within(distances.wary_m, cell_m)) {
  blockers_ = DenseGrid<std::uint16_t>(width, height, static_cast<std::uint16_t>(keep_off_.size() + 1));
}

bool KnownMap::has_room(Place const& middle, double radius_m) const {
  auto const least = cell_at(middle - Shift(radius_m, radius_m));
  auto const most = cell_at(middle + Shift(radius_m, radius_m));
  for (int y = least.y; y <= most.y; ++y) {
    for (int x = least.x; x <= most.x; ++x) {
      if (at({x, y}) == Knowledge::free) continue;
      double const near_x = std::clamp(middle.x(), x * cell_m_, (x + 1) * cell_m_);
      double const near_y = std::clamp(middle.y(), y * cell_m_, (y + 1) * cell_m_);
      if (std::hypot(near_x - middle.x(), near_y - middle.y()) < radius_m) return false;
    }
  }
  return true;
}

std::vector<std::uint32_t> KnownMap::mark_ends(Scan const& scan, std::span<Shift const> ways,
                                               std::span<Disc const> moving) {
  std::vector<std::uint32_t> ends;
  for (std::size_t beam = 0; beam < ways.size(); ++beam) {
    double const range_m = scan.ranges_m[beam];
    if (range_m >= scan.range_m) continue;
    auto const& way = ways[beam];
    auto const end = scan.from.position + range_m * way;
    if (std::ranges::any_of(moving, [&](Disc const& disc) { return distance_m(disc.middle, end) < disc.radius_m; }))
      continue;
    auto const cell = cell_at(end + into_the_wall * cell_m_ * way);
    if (!state_.contains(cell) || hit_by_[cell] == scans_) continue;
    hit_by_[cell] = scans_;
    ends.push_back(static_cast<std::uint32_t>(state_.index_of(cell)));
  }
  return ends;
}

void KnownMap::add(Scan const& scan, std::span<Disc const> moving) {
  ++scans_;
  time_s_ = scan.time_s;
  double const x = scan.from.position.x() / cell_m_;
  double const y = scan.from.position.y() / cell_m_;
  auto const ways = beam_ways(scan.from.yaw_rad, scan.ranges_m.size());
  auto const ends = mark_ends(scan, ways, moving);
  for (std::size_t beam = 0; beam < ways.size(); ++beam) {
    double const length = scan.ranges_m[beam] / cell_m_ - 0.3;
    walk_line(x, y, ways[beam].x(), ways[beam].y(), length, [&](Cell cell, double) {
      if (!state_.contains(cell)) return false;
      auto const index = state_.index_of(cell);
      if (hit_by_.at_index(index) != scans_) pass(index);
      return true;
    });
  }
  if (!has_seen_movement_) notice_movement(ends);
  for (auto const index : ends) hit(index);
}

void KnownMap::notice_movement(std::span<std::uint32_t const> ends) {
  // Beside walls, noise makes ends in free cells, too.
  auto const is_in_the_open = [&](std::uint32_t index) {
    if (state_.at_index(index) != Knowledge::free || odds_.at_index(index) > least_odds / 2) return false;
    auto const cell = state_.cell_of(index);
    constexpr int reach = 2;
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        if (at(cell + Cell{x, y}) != Knowledge::free) return false;
      }
    }
    return true;
  };
  has_seen_movement_ = std::ranges::count_if(ends, is_in_the_open) >= ends_of_movement;
}

void KnownMap::learn(Cell cell, Knowledge knowledge) {
  auto const index = state_.index_of(cell);
  auto& odds = odds_.at_index(index);
  odds = 0;
  if (knowledge == Knowledge::wall) odds = most_odds;
  if (knowledge == Knowledge::free) odds = least_odds;
  become(index, knowledge);
  is_sure_.at_index(index) = 1;
}

void KnownMap::add_driven(Cell cell) {
  if (driven_.contains(cell) && driven_[cell]++ == 0 && blockers_[cell] != 0)
    changed_.push_back(static_cast<std::uint32_t>(state_.index_of(cell)));
}

void KnownMap::take_back_driven(Cell cell) {
  if (driven_.contains(cell) && --driven_[cell] == 0 && blockers_[cell] != 0)
    changed_.push_back(static_cast<std::uint32_t>(state_.index_of(cell)));
}

void KnownMap::pass(std::size_t index) {
  auto& odds = odds_.at_index(index);
  if (odds <= least_odds) return;
  --odds;
  if (odds <= often_free) was_free_.at_index(index) = 1;
  auto const state = state_.at_index(index);
  if (state == Knowledge::unknown || (state == Knowledge::wall && odds < 0)) become(index, Knowledge::free);
}

void KnownMap::hit(std::size_t index) {
  auto& odds = odds_.at_index(index);
  bool const was_free_often = odds < least_odds / 2;
  odds = static_cast<std::int8_t>(std::min<int>(most_odds, odds + (was_free_often ? 1 : 3)));
  if (state_.at_index(index) == Knowledge::wall) {
    double const needed_s = was_free_.at_index(index) != 0 ? sure_where_free_s : sure_after_s;
    if (time_s_ - static_cast<double>(wall_since_s_.at_index(index)) >= needed_s) is_sure_.at_index(index) = 1;
  } else if (odds > 0) {
    become(index, Knowledge::wall);
    wall_since_s_.at_index(index) = static_cast<float>(time_s_);
    is_sure_.at_index(index) = 0;
  }
}

void KnownMap::become(std::size_t index, Knowledge knowledge) {
  auto const before = state_.at_index(index);
  if (before == knowledge) return;
  state_.at_index(index) = knowledge;
  if (before == Knowledge::unknown) ++discovered_;
  fresh_.push_back(static_cast<std::uint32_t>(index));
  auto const cell = state_.cell_of(index);
  if ((before == Knowledge::free) != (knowledge == Knowledge::free))
    count_blocker(cell, knowledge == Knowledge::free ? -1 : 1);
  if ((before == Knowledge::wall) != (knowledge == Knowledge::wall))
    count_wall(cell, knowledge == Knowledge::wall ? 1 : -1);
  look_for_frontier(cell);
  for (std::size_t i = 0; i < 4; ++i) look_for_frontier(cell + neighbours[i]);
}

void KnownMap::count_blocker(Cell cell, int step) {
  auto const count = [&](Cell at) {
    if (!blockers_.contains(at)) return;
    auto& blockers = blockers_[at];
    blockers = static_cast<std::uint16_t>(blockers + step);
    if (blockers == 0 || (step == 1 && blockers == 1))
      changed_.push_back(static_cast<std::uint32_t>(state_.index_of(at)));
  };
  count(cell);
  for (auto const away : keep_off_) count(cell + away);
}

void KnownMap::count_wall(Cell cell, int step) {
  for (auto const away : wary_) {
    if (walls_near_.contains(cell + away))
      walls_near_[cell + away] = static_cast<std::uint16_t>(walls_near_[cell + away] + step);
  }
}

void KnownMap::look_for_frontier(Cell cell) {
  if (!state_.contains(cell)) return;
  bool const is_one = state_[cell] == Knowledge::free &&
                      std::ranges::any_of(std::span(neighbours).first<4>(),
                                          [&](Cell away) { return at(cell + away) == Knowledge::unknown; });
  auto& place = frontier_place_[cell];
  if (is_one == (place != 0)) return;
  if (is_one) {
    frontier_.push_back(static_cast<std::uint32_t>(state_.index_of(cell)));
    place = static_cast<std::uint32_t>(frontier_.size());
    return;
  }
  // The last takes its place.
  auto const last = frontier_.back();
  frontier_[place - 1] = last;
  frontier_place_.at_index(last) = place;
  frontier_.pop_back();
  place = 0;
}

}  // namespace lapwing::explore
