#include "sim/guidance/guidance.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::sim {

double closing_speed(double distance_m, double gain_per_s, double accel_m_s2) {
  double const size = std::abs(distance_m);
  double const linear = accel_m_s2 / (gain_per_s * gain_per_s);
  double const speed = size <= linear ? size * gain_per_s : std::sqrt(2.0 * accel_m_s2 * (size - linear / 2.0));
  return std::copysign(speed, distance_m);
}

geo::Ned stopping_point(Body const& body, Airframe const& airframe, Pace const& pace) {
  auto point = body.position_m;
  if (airframe.family == vehicle::Family::plane) return point;
  constexpr double lag_s = 0.4;  // until the vehicle has tilted against its motion
  double const time_s = lag_s + 0.5 * body.ground_speed_m_s() / pace.accel_m_s2;
  point.north += body.velocity_m_s.north * time_s;
  point.east += body.velocity_m_s.east * time_s;
  return point;
}

bool has_reached(Body const& body, geo::Ned from, geo::Ned point, double radius_m) {
  double const north = point.north - body.position_m.north;
  double const east = point.east - body.position_m.east;
  if (std::hypot(north, east) <= radius_m) return true;
  double const leg_north = point.north - from.north;
  double const leg_east = point.east - from.east;
  bool const on_a_leg = std::hypot(leg_north, leg_east) > radius_m;
  return on_a_leg && north * leg_north + east * leg_east <= 0.0;
}

Demand steer(Goal const& goal, Body const& body, Airframe const& airframe, Pace const& pace) {
  if (std::holds_alternative<StandStill>(goal)) return MotorsOff{};
  if (airframe.family == vehicle::Family::plane) return steer_wing(goal, body, airframe, pace);
  if (airframe.family == vehicle::Family::rover) return steer_wheels(goal, body, pace);
  return steer_rotor(goal, body, pace);
}

}  // namespace lapwing::sim
