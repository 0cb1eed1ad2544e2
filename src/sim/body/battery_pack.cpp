#include "sim/body/battery_pack.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::sim {

namespace {
constexpr double avionics_a = 0.5;
constexpr double inner_resistance_ohm = 0.02;
constexpr double full_v = 12.6;
constexpr double knee_v = 11.1;  ///< where the flat part of the discharge curve ends, at 10 % left
constexpr double empty_v = 9.6;
constexpr double knee_at = 0.1;
}  // namespace

void BatteryPack::drain(double current_a, double dt_s) {
  current_a_ = current_a;
  used_mah_ = std::min(capacity_mah_, used_mah_ + current_a * dt_s / 3.6);
}

double BatteryPack::remaining() const {
  return std::clamp(1.0 - used_mah_ / capacity_mah_, 0.0, 1.0);
}

double BatteryPack::voltage_v() const {
  double const left = remaining();
  double const open = left > knee_at ? knee_v + (full_v - knee_v) * (left - knee_at) / (1.0 - knee_at)
                                     : empty_v + (knee_v - empty_v) * left / knee_at;
  return open - current_a_ * inner_resistance_ohm;
}

double current_drawn_a(Body const& body, Airframe const& airframe, bool motors_run) {
  if (!motors_run) return avionics_a;
  double const up = -body.velocity_m_s.down;
  double const climb = std::max(0.0, up);
  using enum vehicle::Family;
  if (airframe.family == rover) return avionics_a + 0.5 + 1.2 * body.ground_speed_m_s();
  if (airframe.family == sub) return avionics_a + 1.0 + 2.0 * std::hypot(body.ground_speed_m_s(), up);
  if (airframe.family == plane) {
    double const air = body.airspeed_m_s / 20.0;
    return avionics_a + 1.0 + 6.0 * air * air * air + 3.0 * climb;
  }
  if (body.on_ground) return avionics_a + 2.0;
  // Hover power falls a little in forward flight before drag takes over (translational lift).
  double const forward = std::min(body.airspeed_m_s, 20.0);
  // Thrust times the speed of the air through the rotors: a slow descent saves what a climb costs (momentum theory for
  // axial flight, Leishman 2006, 2.13; it holds to about half the induced velocity, 2 m/s here).
  double const axial = std::max(-2.0, up);
  return avionics_a + 16.0 - 0.4 * forward + 0.05 * forward * forward + 2.5 * axial;
}

}  // namespace lapwing::sim
