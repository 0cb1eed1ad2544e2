#pragma once

#include <vector>

#include "explore/strategy/strategy.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot::ros {

/// The nearest in fifteen degrees to either side of left, ahead and right, from the laser; as far as a sonar hears
/// where nothing is nearer. `ranges`: in the sensor's order.
[[nodiscard]] explore::SideDistances sides_of(slam::Sensor const& sensor, std::vector<float> const& ranges);

}  // namespace lapwing::robot::ros
