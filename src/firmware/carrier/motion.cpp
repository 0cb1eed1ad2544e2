#include "firmware/carrier/motion.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::firmware {

WheelSpeeds wheel_speeds(Motion const& motion, Description const& body) {
  float const top = body.top_speed_m_s;
  float const turn = std::clamp(motion.turn_rad_s * body.wheel_base_m / 2, -top, top);
  float const most = top - std::abs(turn);
  float const speed = std::clamp(motion.speed_m_s, -most, most);
  return {.left_m_s = speed - turn, .right_m_s = speed + turn};
}

Motion motion_of(WheelSpeeds const& wheels, Description const& body) {
  return {.speed_m_s = (wheels.left_m_s + wheels.right_m_s) / 2,
          .turn_rad_s = (wheels.right_m_s - wheels.left_m_s) / body.wheel_base_m};
}

Motion ramp(Motion const& from, Motion const& to, float period_s, Tuning const& tuning, float braking_m_s2) {
  bool const is_slowing = std::abs(to.speed_m_s) < std::abs(from.speed_m_s) || to.speed_m_s * from.speed_m_s < 0;
  float const speed_step = period_s * (is_slowing ? braking_m_s2 : tuning.acceleration_m_s2);
  float const turn_step = period_s * tuning.turn_acceleration_rad_s2;
  return {.speed_m_s = from.speed_m_s + std::clamp(to.speed_m_s - from.speed_m_s, -speed_step, speed_step),
          .turn_rad_s = from.turn_rad_s + std::clamp(to.turn_rad_s - from.turn_rad_s, -turn_step, turn_step)};
}

float turn_for(float error_rad, Tuning const& tuning) {
  float const stoppable = std::sqrt(2 * tuning.turn_acceleration_rad_s2 * std::abs(error_rad));
  float const most = std::min(tuning.top_turn_rad_s, stoppable);
  return std::clamp(tuning.heading_gain_per_s * error_rad, -most, most);
}

}  // namespace lapwing::firmware
