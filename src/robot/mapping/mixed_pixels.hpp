#pragma once

#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// A scan without its mixed pixels: a beam that an edge cuts in two gives a range between the edge and what is behind
/// it, where there is nothing. Such readings, which lie alone between two surfaces, become 0, nothing measured.
///
/// Told by the angle at which a beam would have to meet a surface through its neighbours (the shadow filter of ROS'
/// laser_filters); but walls that a corridor shows so aslant go on beyond the neighbours, and stay.
[[nodiscard]] slam::Scan without_mixed_pixels(slam::Scan scan, slam::Sensor const& sensor);

}  // namespace lapwing::robot
