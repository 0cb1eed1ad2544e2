#include "robot/sensors/attitude.hpp"

#include <cmath>
#include <numbers>

namespace lapwing::robot {

namespace {

/// The sine of 89.5 degrees: nearer to the pole the two angles would be noise.
double constexpr polar_sine = 0.99996;

}  // namespace

Attitude attitude(firmware::Quaternion const& orientation) {
  double const w = orientation.w;
  double const x = orientation.x;
  double const y = orientation.y;
  double const z = orientation.z;
  double const length2 = w * w + x * x + y * y + z * z;
  double const sine_of_pitch = 2 * (w * y - z * x) / length2;
  if (std::abs(sine_of_pitch) > polar_sine) {
    double const yaw = std::copysign(2.0, -sine_of_pitch) * std::atan2(x, w);
    return {.yaw_rad = std::remainder(yaw, 2 * std::numbers::pi),
            .pitch_rad = std::copysign(std::numbers::pi / 2, sine_of_pitch),
            .roll_rad = 0};
  }
  return {.yaw_rad = std::atan2(2 * (w * z + x * y), length2 - 2 * (y * y + z * z)),
          .pitch_rad = std::asin(sine_of_pitch),
          .roll_rad = std::atan2(2 * (w * x + y * z), length2 - 2 * (x * x + y * y))};
}

}  // namespace lapwing::robot
