#pragma once

#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// Whether the robot stands where it was at the scan `before`, though by its wheels it has `driven` since: nearly all
/// readings that would have changed on that way have not. Walls along the way say nothing; who walks along with the
/// robot looks as if it stood, but takes a few directions only, and so do walls far ahead: then, and after a turn, the
/// answer is no. Precondition: both scans are of this sensor.
[[nodiscard]] bool stands_still(slam::Scan const& before, slam::Scan const& now, slam::Sensor const& sensor,
                                slam::Pose2 const& driven);

}  // namespace lapwing::robot
