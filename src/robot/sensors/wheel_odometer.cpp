#include "robot/sensors/wheel_odometer.hpp"

#include <cmath>

namespace lapwing::robot {

namespace {

/// A wheel may overshoot its top speed downhill, and readings may come a little late.
double constexpr possible_factor = 2.0;

/// Modulo 2^32, so that a counter that wraps goes on.
double pulses_between(std::int32_t before, std::int32_t after) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(after) - static_cast<std::uint32_t>(before));
}

}  // namespace

std::optional<WheelOdometer::Step> WheelOdometer::feed(firmware::Readings const& readings) {
  Last const now{.time = readings.time, .left = readings.left_pulses, .right = readings.right_pulses};
  if (!last_) {
    last_ = now;
    return std::nullopt;
  }
  if (now.time <= last_->time) return std::nullopt;
  auto const pulses_per_m = static_cast<double>(body_.pulses_per_m);
  Step step{.wheels = {.period = now.time - last_->time,
                       .left_m = pulses_between(last_->left, now.left) / pulses_per_m,
                       .right_m = pulses_between(last_->right, now.right) / pulses_per_m,
                       .wheel_base_m = static_cast<double>(body_.wheel_base_m)}};
  last_ = now;
  auto& wheels = step.wheels;
  double const most_m = possible_factor * static_cast<double>(body_.top_speed_m_s) * wheels.seconds();
  if (std::abs(wheels.left_m) > most_m || std::abs(wheels.right_m) > most_m) {
    step.has_jumped = true;
    wheels.left_m = wheels.right_m = 0;
  }
  return step;
}

}  // namespace lapwing::robot
