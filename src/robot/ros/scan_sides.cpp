#include "robot/ros/scan_sides.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/position.hpp"

namespace lapwing::robot::ros {

namespace {

constexpr double side_m = 5.0;
constexpr double front_m = 7.5;
constexpr double half_cone_rad = 15.0 * std::numbers::pi / 180.0;

}  // namespace

explore::SideDistances sides_of(slam::Sensor const& sensor, std::vector<float> const& ranges) {
  explore::SideDistances sides{.left_m = side_m, .front_m = front_m, .right_m = side_m};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (!sensor.is_reading(ranges[i])) continue;
    auto const is_towards = [&](double yaw_rad) {
      return std::abs(geo::wrap_pi(sensor.bearings_rad[i] - yaw_rad)) < half_cone_rad;
    };
    double const range_m = ranges[i];
    if (is_towards(0.0)) sides.front_m = std::min(sides.front_m, range_m);
    if (is_towards(std::numbers::pi / 2.0)) sides.left_m = std::min(sides.left_m, range_m);
    if (is_towards(-std::numbers::pi / 2.0)) sides.right_m = std::min(sides.right_m, range_m);
  }
  return sides;
}

}  // namespace lapwing::robot::ros
