#pragma once

#include <string_view>

#include "base/error.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

inline constexpr std::size_t tof_swarm_columns = 47;

/// Reads a table of small drones with four time-of-flight cameras of eight columns each: `drone, node, frame, odometry
/// x y yaw, optimised x y yaw, true x y yaw, offset dx dy dyaw of the frame from its node`, then depths of the cameras
/// that look to the front, back, left and right, metres; below 0: nothing came back. `#` begins a comment. There are no
/// times: a scan counts a tenth of a second. Of several drones the one with the most scans is read, for their tracks
/// are not of one robot. Errors: invalid_input, with the line.
[[nodiscard]] base::Result<ScanLog> read_tof_swarm(std::string_view text);

}  // namespace lapwing::slam
