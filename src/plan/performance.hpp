#pragma once

#include "vehicle/family.hpp"

namespace lapwing::plan {

/// How a vehicle flies on paper. What is zero costs nothing: the defaults know speeds only.
struct Performance {
  double cruise_m_s = 10.0;
  double climb_m_s = 2.5;
  double descent_m_s = 1.5;

  // Legs.
  double accel_m_s2 = 0.0;  ///< 0: every speed at once
  double brake_m_s2 = 0.0;
  double vertical_accel_m_s2 = 0.0;
  double pass_share = 1.0;         ///< of the cruise speed that is kept at a waypoint behind which the way goes on
  double waypoint_radius_m = 0.0;  ///< so near is there
  double turn_rate_rad_s = 0.0;    ///< of a vehicle that has to keep moving; 0: turns on the spot
  double pivot_s_per_rad = 0.0;    ///< what turning on the spot takes
  double circle_accel_m_s2 = 0.0;  ///< centripetal, which bounds the speed on circles; 0: nothing does

  // Ends.
  double spool_up_s = 0.0;       ///< before a take-off
  double landing_m_s = 0.0;      ///< the last metres of a landing; 0: as any descent
  double landing_below_m = 0.0;  ///< where those begin
  double touch_down_s = 0.0;     ///< from the ground until it counts as landed
  double return_height_m = 0.0;  ///< above home, at least, on the way home
  double return_wait_s = 0.0;    ///< over home
  double circle_radius_m = 0.0;  ///< on which it waits; 0: it can stand still
  bool flies = true;

  /// More is known than speeds.
  [[nodiscard]] bool is_detailed() const { return accel_m_s2 > 0.0 || turn_rate_rad_s > 0.0; }
};

/// With the parameters that ArduPilot has from the start (WPNAV_SPEED 10 m/s, AIRSPEED_CRUISE 22 m/s, WP_SPEED 5 m/s
/// ...): within 10 % of what the simulator flies in still air. Boats and robots are taken for rovers; families of which
/// nothing is known, for copters.
[[nodiscard]] Performance performance_of(vehicle::Family family);

/// Through the air; neither on wheels nor in the water.
[[nodiscard]] constexpr bool flies(vehicle::Family family) {
  using enum vehicle::Family;
  return family != rover && family != boat && family != sub && family != robot;
}

}  // namespace lapwing::plan
