#pragma once

#include <vector>

#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// What a robot's wheels tell wrongly all the time: it pulls to one side, or turns more than it is told.
struct OdometryBias {
  double turn_per_m = 0.0;    ///< radians that are missing, of each metre driven forwards
  double turn_per_rad = 0.0;  ///< of each radian turned
};

/// The poses that odometry would have told without it.
[[nodiscard]] std::vector<Pose2> without_bias(std::vector<Pose2> const& odometry, OdometryBias const& bias);

/// The bias with which what is seen over a few metres of the way lies in the fewest cells: walls are straight, and
/// wheels that err bend them. For scans of few beams, which are laid together by odometry alone and would be bent all
/// alike, so that they fit each other well. Zero where nothing is sharper. Precondition: as many poses as scans.
[[nodiscard]] OdometryBias find_bias(ScanLog const& log, std::vector<Pose2> const& odometry);

}  // namespace lapwing::slam
