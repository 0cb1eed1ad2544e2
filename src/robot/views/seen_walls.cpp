#include "robot/views/seen_walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "robot/views/look_book.hpp"

namespace lapwing::robot {

namespace {

/// How far off a wall is seen, and how much aslant.
struct Reach {
  double farthest_m;
  double most_slant_rad;
};
/// Across a hall, whose walls the robot may never come near to by itself.
constexpr Reach to_pass{.farthest_m = 12.0, .most_slant_rad = 1.4};
constexpr Reach to_read{.farthest_m = 3.0, .most_slant_rad = 1.0};             ///< beyond, letters are too small
constexpr Reach to_notice{.farthest_m = most_range_m, .most_slant_rad = 0.9};  ///< with enough pixels
/// Where in a picture the wall is looked for, in parts of its view: nearer to its edges signs are cut off.
constexpr std::array parts_of_a_view{-0.32, -0.16, 0.0, 0.16, 0.32};
/// So near to each other that none misses what is as wide as a sign.
constexpr int lines_all_round = 120;
constexpr double unclear_px_m = 0.9 * LookBook::noticed_px_m;  ///< at best, where something is not in the picture

bool is_within(Reach const& reach, WallPoint const& wall, double way_rad) {
  double const slant_rad = std::abs(geo::wrap_pi(wall.facing_rad + std::numbers::pi - way_rad));
  return wall.range_m <= reach.farthest_m && slant_rad <= reach.most_slant_rad;
}

}  // namespace

std::vector<SeenWall> walls_in_picture(map::OccupancyGrid const& grid, CameraMount const& mount,
                                       geo::Pose<geo::SiteFrame> const& body) {
  std::vector<SeenWall> walls;
  for (double const part : parts_of_a_view) {
    double const bearing_rad = mount.yaw_rad + part * mount.view_rad;
    double const way_rad = body.yaw_rad + bearing_rad;
    auto const wall = wall_seen(grid, body, mount, bearing_rad);
    // A picture that does not show low tags is not taken; in one that does not show high ones, a tag may be missing.
    if (!wall || !is_in_the_picture(mount, low_tag_m, wall->range_m)) continue;
    double const clear = clearness(mount, *wall, way_rad);
    bool const is_noticed = is_within(to_notice, *wall, way_rad) && clear >= LookBook::noticed_px_m;
    if (!is_noticed && !is_within(to_read, *wall, way_rad)) continue;
    bool const shows_all = is_in_the_picture(mount, high_tag_m, wall->range_m);
    walls.push_back({.wall = *wall, .clearness = shows_all ? clear : std::min(clear, unclear_px_m)});
  }
  return walls;
}

bool is_readable(WallPoint const& wall, double way_rad) {
  return is_within(to_read, wall, way_rad);
}

std::vector<WallPoint> walls_round(map::OccupancyGrid const& grid, geo::Pose<geo::SiteFrame> const& body) {
  std::vector<WallPoint> walls;
  CameraMount const middle{.x_m = 0.0, .y_m = 0.0};
  for (int k = 0; k < lines_all_round; ++k) {
    double const bearing_rad = 2.0 * std::numbers::pi * k / lines_all_round;
    auto const wall = wall_seen(grid, body, middle, bearing_rad, to_pass.farthest_m);
    if (wall && is_within(to_pass, *wall, body.yaw_rad + bearing_rad)) walls.push_back(*wall);
  }
  return walls;
}

}  // namespace lapwing::robot
