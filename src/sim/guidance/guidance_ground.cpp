#include <algorithm>
#include <cmath>

#include "sim/guidance/guidance.hpp"

namespace lapwing::sim {

namespace {

WheelDemand towards(geo::Ned point, Body const& body, Pace const& pace, bool passing) {
  double const north = point.north - body.position_m.north;
  double const east = point.east - body.position_m.east;
  double const distance = std::hypot(north, east);
  if (distance < 0.1) return {};
  double const error = geo::wrap_pi(std::atan2(east, north) - body.attitude.yaw_rad);
  double const stopping = closing_speed(distance, 1.0, 0.7 * pace.accel_m_s2);
  double speed = std::min(pace.speed_m_s, passing ? std::max(stopping, 0.4 * pace.speed_m_s) : stopping);
  // Slow down to turn: a point behind is turned to almost on the spot.
  speed *= std::max(0.15, std::cos(std::clamp(error, -1.5, 1.5)));
  // Close by, turning after the bearing would end in circles round the point.
  double const turn = std::clamp(2.0 * error, -1.5, 1.5) * std::min(1.0, distance);
  return {std::abs(error) > 1.2 && distance < 1.0 ? 0.0 : speed, turn};
}

WheelDemand around(Circle const& circle, Body const& body, Pace const& pace) {
  double const north = body.position_m.north - circle.center.north;
  double const east = body.position_m.east - circle.center.east;
  double const radius = std::max(1.0, std::abs(circle.radius_m));
  double const sense = circle.radius_m < 0.0 ? -1.0 : 1.0;
  double const bearing = std::atan2(east, north);
  double const off = std::clamp((std::hypot(north, east) - radius) / radius, -1.0, 1.0);
  double const course = bearing + sense * (std::numbers::pi / 2.0 + off);
  double const speed = std::min(pace.speed_m_s, std::sqrt(3.0 * radius));
  double const turn = 2.0 * geo::wrap_pi(course - body.attitude.yaw_rad) + sense * speed / radius;
  return {speed, turn};
}

}  // namespace

Demand steer_wheels(Goal const& goal, Body const& body, Pace const& pace) {
  if (auto const* hold = std::get_if<HoldAt>(&goal)) {
    double const off = std::hypot(hold->point.north - body.position_m.north, hold->point.east - body.position_m.east);
    return off > 2.0 ? towards(hold->point, body, pace, false) : WheelDemand{};
  }
  if (auto const* way = std::get_if<FlyTo>(&goal)) return towards(way->point, body, pace, way->passing);
  if (auto const* circle = std::get_if<Circle>(&goal)) return around(*circle, body, pace);
  if (auto const* wanted = std::get_if<Steer>(&goal)) return WheelDemand{wanted->speed_m_s, wanted->turn_rate_rad_s};
  if (auto const* cruise = std::get_if<Cruise>(&goal)) {
    double const speed = std::hypot(cruise->velocity_m_s.north, cruise->velocity_m_s.east);
    if (speed < 0.05) return WheelDemand{};
    double const course = std::atan2(cruise->velocity_m_s.east, cruise->velocity_m_s.north);
    return WheelDemand{speed, 2.0 * geo::wrap_pi(course - body.attitude.yaw_rad)};
  }
  return WheelDemand{};
}

}  // namespace lapwing::sim
