#pragma once

#include "firmware/frames/description.hpp"
#include "robot/carrier/scan.hpp"
#include "robot/ranges/board_odometry.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// How the laser looks, for the mapping: beams in ascending order.
[[nodiscard]] slam::Sensor sensor_of(firmware::LaserPlace const& laser);

/// When the last beam of a scan was taken. Before odometry knows of that time, nobody can say where it looked from.
[[nodiscard]] firmware::Time end_of(LaserRanges const& scan, firmware::LaserPlace const& laser);

/// Lays each beam where it looked from, as the middle of the scan would have seen its end (`slam::deskewed`).
/// Precondition: as many ranges as the laser has beams.
[[nodiscard]] slam::Scan lay(LaserRanges const& scan, firmware::LaserPlace const& laser, slam::Sensor const& sensor,
                             BoardOdometry const& odometry);

}  // namespace lapwing::robot
