#pragma once

#include <algorithm>
#include <cmath>

#include "geo/position.hpp"

namespace lapwing::explore {

/// How the drone flies: speeds as those of ArduPilot's WPNAV parameters, slower, for sharp pictures.
struct FlightLimits {
  double speed_m_s = 5.0;
  double acceleration_m_s2 = 2.0;
  double climb_m_s = 2.0;
  double sink_m_s = 1.5;
  double turn_rad_s = 0.8;
};

/// From standing to standing over level ground: speeding up, flying, slowing down (a trapezoid, or a triangle on a
/// short way).
[[nodiscard]] inline double seconds_to_fly(double way_m, FlightLimits const& limits) {
  double const speed = limits.speed_m_s;
  double const acceleration = limits.acceleration_m_s2;
  if (way_m * acceleration < speed * speed) return 2.0 * std::sqrt(std::max(0.0, way_m) / acceleration);
  return way_m / speed + speed / acceleration;
}

/// Level way, climb and turn are made at once: the longest of them counts.
[[nodiscard]] inline double seconds_to_move(double way_m, double up_m, double turn_rad, FlightLimits const& limits) {
  double const climb_s = up_m > 0.0 ? up_m / limits.climb_m_s : -up_m / limits.sink_m_s;
  double const turn_s = std::abs(geo::wrap_pi(turn_rad)) / limits.turn_rad_s;
  return std::max({seconds_to_fly(way_m, limits), climb_s, turn_s});
}

}  // namespace lapwing::explore
