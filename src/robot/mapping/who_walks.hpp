#pragma once

#include "slam/graph.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// A scan without those who walk about: readings that end where several key frames from farther back on the way saw
/// floor and nothing else become 0, nothing measured. Whoever follows a robot along a corridor at its own speed looks
/// to it like a wall that does not come nearer, and would hold it back on its map.
///
/// Somebody who stays in the line from there to where he walks is not told apart: those key frames saw him, and not
/// what was behind. When a good part of all readings would go, it is taken that the pose is wrong, and the scan is left
/// as it is. `pose`: of the robot at the scan, by its odometry from the graph's last key frame.
[[nodiscard]] slam::Scan without_who_walks(slam::Scan const& scan, slam::Sensor const& sensor, slam::Pose2 const& pose,
                                           slam::Graph const& graph);

}  // namespace lapwing::robot
