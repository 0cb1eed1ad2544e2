#include "robot/views/free_space.hpp"

#include <cmath>
#include <numbers>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr double room_m = 0.3;  ///< around the robot's middle
constexpr double taken = 0.6;   ///< probability from which on a cell is a wall's

}  // namespace

map::SitePoint away(map::SitePoint const& from, double way_rad, double by_m) {
  return {from.x() + by_m * std::cos(way_rad), from.y() + by_m * std::sin(way_rad)};
}

bool FreeSpace::is_free(map::SitePoint const& place) const {
  auto const evidence = grid_.at(grid_.cell_at(grid_from_site_ * place));
  return evidence.is_seen() && evidence.probability() < taken;
}

bool FreeSpace::is_taken(map::SitePoint const& place) const {
  auto const evidence = grid_.at(grid_.cell_at(grid_from_site_ * place));
  return evidence.is_seen() && evidence.probability() >= taken;
}

bool FreeSpace::has_room(map::SitePoint const& place) const {
  constexpr int directions = 12;
  for (int k = 0; k < directions; ++k)
    if (!is_clear(place, away(place, 2.0 * std::numbers::pi * k / directions, room_m))) return false;
  return true;
}

bool FreeSpace::is_clear(map::SitePoint const& from, map::SitePoint const& to) const {
  double const far_m = geo::distance_m(from, to);
  double const way_rad = std::atan2(to.y() - from.y(), to.x() - from.x());
  double const step_m = grid_.resolution_m() / 2.0;
  for (double along_m = 0.0; along_m < far_m; along_m += step_m)
    if (!is_free(away(from, way_rad, along_m))) return false;
  return true;
}

}  // namespace lapwing::robot
