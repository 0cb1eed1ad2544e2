#include "robot/planner/driven_track.hpp"

#include <algorithm>

#include "explore/floor/ray.hpp"

namespace lapwing::robot {

using explore::Cell;
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
}

}  // namespace lapwing::robot
