#pragma once

#include <span>

#include <Eigen/Core>

#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// Another robot, where it is said to be on the map.
struct OtherRobot {
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
};

/// A scan without what it shows of other robots: readings that end where one of them is, or near by, as a place that is
/// told is not quite the true one, become 0, nothing measured. One that stands for a while would stay on the map as a
/// wall wherever nobody looks again after it has left. `pose`: of the robot at the scan, on the map.
[[nodiscard]] slam::Scan without_robots(slam::Scan scan, slam::Sensor const& sensor, slam::Pose2 const& pose,
                                        std::span<OtherRobot const> others);

}  // namespace lapwing::robot
