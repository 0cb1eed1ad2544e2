#include "robot/views/viewpoint.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "robot/views/free_space.hpp"

namespace lapwing::robot {

namespace {

/// How far off, and how far aside from straight before it, the better ones first.
constexpr std::array<double, 6> ranges_m{1.2, 1.0, 1.5, 0.8, 2.0, 2.5};
constexpr std::array<double, 5> asides_rad{0.0, 0.3, -0.3, 0.6, -0.6};
constexpr double off_wall_m = 0.15;  ///< where the line of sight ends, so that the wall's own cells do not count

/// The one that looks ahead most of those that show it: the robot turns least from the way that it came.
std::optional<std::size_t> eye_for(std::span<CameraMount const> mounts, double height_m, double range_m) {
  std::optional<std::size_t> best;
  for (std::size_t k = 0; k < mounts.size(); ++k) {
    if (!is_in_the_picture(mounts[k], height_m, range_m)) continue;
    if (!best || std::abs(mounts[k].yaw_rad) < std::abs(mounts[*best].yaw_rad)) best = k;
  }
  return best;
}

/// From `from_m` to `to_m` before a place, which was told by a few cells and may have come out beside its wall.
bool is_wall(FreeSpace const& space, map::SitePoint const& place, double facing_rad, double from_m, double to_m) {
  constexpr double step_m = 0.05;
  for (double before_m = from_m; before_m < to_m + step_m / 2.0; before_m += step_m)
    if (space.is_taken(away(place, facing_rad, before_m))) return true;
  return false;
}

}  // namespace

bool is_wide_enough(OnWall const& what, map::OccupancyGrid const& grid) {
  constexpr double half_m = 0.15;
  FreeSpace const space(grid);
  double const along_rad = what.facing_rad + std::numbers::pi / 2.0;
  auto const is_wall_at = [&](double along_m) {
    return is_wall(space, away(what.position, along_rad, along_m), what.facing_rad, -0.1, 0.05);
  };
  return is_wall_at(-half_m) && is_wall_at(-half_m / 2.0) && is_wall_at(half_m / 2.0) && is_wall_at(half_m);
}

bool is_beside_an_opening(OnWall const& what, map::OccupancyGrid const& grid) {
  constexpr double reach_m = 0.8;
  constexpr double step_m = 0.1;
  constexpr double doorway_m = 0.6;
  constexpr double widest_m = 1.6;
  // A place on a wall, and which way that faces, are told by a few cells: one may come out just before the wall, so
  // that an opening has to lead through it.
  constexpr double before_m = 0.15;
  constexpr double behind_m = 0.25;
  constexpr double astray_m = 0.2;  // by a few degrees, over a doorway
  FreeSpace const space(grid);
  auto const leads_through = [&](map::SitePoint const& place) {
    return space.is_clear(away(place, what.facing_rad, before_m), away(place, what.facing_rad, -behind_m));
  };
  for (double const side : {-1.0, 1.0}) {
    double const along_rad = what.facing_rad + side * std::numbers::pi / 2.0;
    double open_m = 0.0;
    for (double along_m = step_m; along_m - open_m < reach_m && open_m <= widest_m; along_m += step_m) {
      if (leads_through(away(what.position, along_rad, along_m))) {
        open_m += step_m;
        continue;
      }
      for (double const further_m : {0.0, step_m, 2.0 * step_m}) {
        auto const place = away(what.position, along_rad, along_m + further_m);
        if (open_m >= doorway_m && is_wall(space, place, what.facing_rad, -astray_m, astray_m)) return true;
      }
      open_m = 0.0;
    }
  }
  return false;
}

std::vector<Viewpoint> viewpoints_for(OnWall const& what, map::OccupancyGrid const& grid,
                                      std::span<CameraMount const> mounts) {
  std::vector<Viewpoint> views;
  FreeSpace const space(grid);
  for (double const aside_rad : asides_rad) {
    for (double const range_m : ranges_m) {
      double const way_rad = what.facing_rad + aside_rad;
      auto const from = away(what.position, way_rad, range_m);
      auto const eye = eye_for(mounts, what.height_m, range_m);
      if (!eye || !space.has_room(from)) continue;
      if (!space.is_clear(from, away(what.position, way_rad, off_wall_m))) continue;
      views.push_back({.from = from, .at = what.position, .eye = *eye, .bearing_rad = mounts[*eye].yaw_rad});
    }
  }
  return views;
}

}  // namespace lapwing::robot
