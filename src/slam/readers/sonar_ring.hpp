#pragma once

#include <string_view>

#include "base/error.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

inline constexpr std::size_t sonar_ring_columns = 25;

/// Reads a table of 24 ranges of sonars around a robot, the first to the front and on clockwise, with a word after them
/// that says what the robot did: the "Wall-Following Robot Navigation" data of a SCITOS G5, nine lines a second,
/// without odometry; 5 m: nothing came back. Errors: invalid_input, with the line.
[[nodiscard]] base::Result<ScanLog> read_sonar_ring(std::string_view text);

}  // namespace lapwing::slam
