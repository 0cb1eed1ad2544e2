#pragma once

#include <optional>
#include <span>

#include "robot/sensors/sensor_interface.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// How a body without a laser looks: each sonar as a cone from the middle of the axle. Nothing where it has no sonars.
[[nodiscard]] std::optional<slam::Sensor> sensor_of(std::span<firmware::SonarPlace const> sonars);

/// What its sonars say at one moment: each echo where it came from, by bearing and range from the axle's middle. A cone
/// without an echo is told as such; a sonar that is not believed says nothing. Precondition: the sensor is of these
/// sonars.
[[nodiscard]] slam::Scan scan_of(Sensed const& sensed, slam::Pose2 const& odometry, slam::Sensor const& sensor);

}  // namespace lapwing::robot
