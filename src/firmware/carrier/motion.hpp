#pragma once

#include "firmware/carrier/tuning.hpp"
#include "firmware/frames/description.hpp"

namespace lapwing::firmware {

/// How the body moves, or shall move: along its x axis and about its middle.
struct Motion {
  float speed_m_s = 0;
  float turn_rad_s = 0;
};

struct WheelSpeeds {
  float left_m_s = 0;
  float right_m_s = 0;
};

/// Differential drive: v ∓ ω b/2 with the wheel base b. Where a wheel would have to be too fast the way gives in first
/// and the turn last, so that headings are kept at any speed.
[[nodiscard]] WheelSpeeds wheel_speeds(Motion const& motion, Description const& body);
[[nodiscard]] Motion motion_of(WheelSpeeds const& wheels, Description const& body);

/// `from`, no further changed towards `to` than the accelerations allow within `period_s`.
[[nodiscard]] Motion ramp(Motion const& from, Motion const& to, float period_s, Tuning const& tuning,
                          float braking_m_s2);

/// The rate that turns a heading error away: proportional, at most the top rate, and none faster than could be stopped
/// within what is left, ω² = 2 α |error|.
[[nodiscard]] float turn_for(float error_rad, Tuning const& tuning);

}  // namespace lapwing::firmware
