#include "sim/building/plan/door_opening.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::sim::building {

namespace {

constexpr double tolerance_m = 0.01;

}  // namespace

std::optional<Opening> opening_of(DoorPlan const& door, std::span<WallPlan const> walls) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    auto const along = walls[i].to - walls[i].from;
    double const length_m = along.length();
    if (!(length_m > 0.0)) continue;
    auto const way = along * (1.0 / length_m);
    auto const to_hinge = door.hinge - walls[i].from;
    auto const to_latch = door.latch - walls[i].from;
    if (std::abs(way.cross(to_hinge)) > tolerance_m || std::abs(way.cross(to_latch)) > tolerance_m) continue;
    double const begin_m = std::min(way.dot(to_hinge), way.dot(to_latch));
    double const end_m = std::max(way.dot(to_hinge), way.dot(to_latch));
    if (begin_m < -tolerance_m || end_m > length_m + tolerance_m) continue;
    return Opening{i, std::max(begin_m, 0.0), std::min(end_m, length_m)};
  }
  return std::nullopt;
}

std::vector<Stretch> stretches_between(double length_m, std::vector<Opening> openings) {
  std::ranges::sort(openings, {}, &Opening::begin_m);
  std::vector<Stretch> left;
  double at_m = 0.0;
  for (auto const& opening : openings) {
    if (opening.begin_m > at_m) left.push_back({at_m, opening.begin_m});
    at_m = std::max(at_m, opening.end_m);
  }
  if (length_m > at_m) left.push_back({at_m, length_m});
  return left;
}

}  // namespace lapwing::sim::building
