#include "robot/mapping/other_robots.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::robot {

namespace {

constexpr double not_quite_there_m = 0.2;

}  // namespace

slam::Scan without_robots(slam::Scan scan, slam::Sensor const& sensor, slam::Pose2 const& pose,
                          std::span<OtherRobot const> others) {
  slam::Turn const turn(pose.yaw);
  Eigen::Vector2d const from = slam::place(pose) + turn * sensor.mount_m.cast<double>();
  double const farthest_m = double{sensor.no_return_m};
  bool const is_any_near = std::ranges::any_of(
      others, [&](OtherRobot const& one) { return (one.at - from).norm() < farthest_m + one.radius_m; });
  if (!is_any_near) return scan;
  auto const& bearings = bearings_of(scan, sensor);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!sensor.is_reading(scan.ranges_m[i])) continue;
    double const bearing = pose.yaw + double{bearings[i]};
    Eigen::Vector2d const end = from + double{scan.ranges_m[i]} * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    bool const is_robot = std::ranges::any_of(
        others, [&](OtherRobot const& one) { return (one.at - end).norm() < one.radius_m + not_quite_there_m; });
    if (is_robot) scan.ranges_m[i] = 0.0F;
  }
  return scan;
}

}  // namespace lapwing::robot
