#include "robot/planner/driven_track.hpp"

#include <algorithm>
#include <cmath>

#include "explore/floor/ray.hpp"

namespace lapwing::robot {

using explore::Cell;
using explore::operator+;
using explore::operator-;

namespace {

/// Nobody knows how it came from one place to another that is so far away: its map lost it between.
constexpr double longest_leg_m = 1.0;

template <class Visit>
void for_each_cell(Cell from, Cell to, Visit const& visit) {
  auto const way = to - from;
  double const length = explore::length_of(way);
  visit(from);
  if (length == 0.0) return;
  explore::walk_line(from.x + 0.5, from.y + 0.5, way.x / length, way.y / length, length, [&](Cell cell, double) {
    if (cell != from) visit(cell);
    return true;
  });
}

/// Cells near `here` that are by at least half of the way to them farther from all that is not known to be free.
std::vector<Cell> cells_away(explore::KnownMap const& map, Cell here) {
  constexpr double least_gain = 0.5;
  if (!map.is_too_near(here)) return {};
  double room_m = map.keep_off_m();
  while (room_m > 0.0 && !map.has_room(map.middle(here), room_m)) room_m -= map.cell_m();
  room_m = std::max(room_m, 0.0);
  int const reach = static_cast<int>(std::ceil((map.keep_off_m() - room_m) / least_gain / map.cell_m()));
  std::vector<Cell> found;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      auto const cell = here + Cell{x, y};
      double const wanted_m = room_m + least_gain * std::hypot(x, y) * map.cell_m();
      if (map.is_too_near(cell) && map.has_room(map.middle(cell), wanted_m)) found.push_back(cell);
    }
  }
  return found;
}

}  // namespace

void DrivenTrack::lay(explore::KnownMap& map, std::span<explore::Place const> places) {
  std::vector<Leg> legs;
  legs.reserve(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto const to = map.cell_at(places[i]);
    bool const hangs_together = i > 0 && geo::distance_m(places[i - 1], places[i]) <= longest_leg_m;
    legs.push_back({hangs_together ? map.cell_at(places[i - 1]) : to, to});
  }
  for (std::size_t i = 0; i < std::max(legs.size(), laid_.size()); ++i) {
    if (i < legs.size() && i < laid_.size() && legs[i] == laid_[i]) continue;
    if (i < legs.size()) for_each_cell(legs[i].from, legs[i].to, [&](Cell cell) { map.add_driven(cell); });
    if (i < laid_.size()) for_each_cell(laid_[i].from, laid_[i].to, [&](Cell cell) { map.take_back_driven(cell); });
  }
  laid_ = std::move(legs);
  auto away = laid_.empty() ? std::vector<Cell>() : cells_away(map, laid_.back().to);
  for (auto const cell : away) map.add_driven(cell);
  for (auto const cell : leads_away_) map.take_back_driven(cell);
  leads_away_ = std::move(away);
}

}  // namespace lapwing::robot
