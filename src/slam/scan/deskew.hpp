#pragma once

#include <cstddef>
#include <functional>

#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// A scanner turns while its robot moves. Gives each beam the bearing and the range at which a scanner would have seen
/// its end that was where `scan.odometry` says, all beams at once. What would not have been seen from there, because
/// the sensor does not look that way, has no range. Precondition: as many ranges as the sensor has beams, and no
/// bearings of the scan's own.
/// `pose_of`: by odometry, where the robot was when it took that beam.
[[nodiscard]] Scan deskewed(Scan scan, Sensor const& sensor, std::function<Pose2(std::size_t beam)> const& pose_of);

}  // namespace lapwing::slam
