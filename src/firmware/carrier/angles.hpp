#pragma once

#include <cmath>
#include <numbers>

#include "firmware/frames/records.hpp"

namespace lapwing::firmware {

/// The same direction in [-pi, pi].
[[nodiscard]] inline float wrapped(float angle_rad) {
  return std::remainder(angle_rad, 2 * std::numbers::pi_v<float>);
}

/// Of the body's x axis in the level plane. The quaternion may have any length but zero.
[[nodiscard]] inline float yaw_of(Quaternion const& q) {
  return std::atan2(2 * (q.w * q.z + q.x * q.y), q.w * q.w + q.x * q.x - q.y * q.y - q.z * q.z);
}

}  // namespace lapwing::firmware
