#include <algorithm>
#include <cmath>

#include "sim/guidance/guidance.hpp"

namespace lapwing::sim {

namespace {

constexpr double gravity_m_s2 = 9.80665;
constexpr double climb_gain_per_s = 0.4;
constexpr double flare_height_m = 3.0;
constexpr double flare_sink_m_s = 0.4;

double course_rad(Body const& body) {
  return std::atan2(body.velocity_m_s.east, body.velocity_m_s.north);
}

/// The bank that turns the course over ground by `error` within about two seconds.
double bank_for(double error_rad, Body const& body, double extra_m_s2 = 0.0) {
  double const speed = std::max(body.ground_speed_m_s(), 8.0);
  double const limited = std::clamp(error_rad, -1.2, 1.2);
  return std::atan((0.8 * limited * speed + extra_m_s2) / gravity_m_s2);
}

double climb_for(double down, Body const& body, Pace const& pace) {
  return std::clamp(climb_gain_per_s * (body.position_m.down - down), -pace.sink_m_s, pace.climb_m_s);
}

/// Follows the line of the leg: aims at the point on it a few seconds ahead (after L1, Park, Deyst, How 2004).
WingDemand along(FlyTo const& way, Body const& body, Pace const& pace) {
  double north = way.point.north;
  double east = way.point.east;
  double const leg_n = way.point.north - way.from.north;
  double const leg_e = way.point.east - way.from.east;
  double const length = std::hypot(leg_n, leg_e);
  if (length > 1.0) {
    double const ahead = 4.0 * std::max(body.ground_speed_m_s(), 8.0);
    double const along_m =
        ((body.position_m.north - way.from.north) * leg_n + (body.position_m.east - way.from.east) * leg_e) / length;
    double const aim = std::max(along_m, -ahead) + ahead;
    north = way.from.north + leg_n * aim / length;
    east = way.from.east + leg_e * aim / length;
  }
  double const bearing = std::atan2(east - body.position_m.east, north - body.position_m.north);
  return {pace.speed_m_s, bank_for(geo::wrap_pi(bearing - course_rad(body)), body),
          climb_for(way.point.down, body, pace)};
}

/// Joins and keeps a circle by a vector field round it, with the bank of the steady turn fed forward.
WingDemand around(Circle const& circle, Body const& body, Pace const& pace) {
  double const north = body.position_m.north - circle.center.north;
  double const east = body.position_m.east - circle.center.east;
  double const radius = std::max(20.0, std::abs(circle.radius_m));
  double const sense = circle.radius_m < 0.0 ? -1.0 : 1.0;
  double const distance = std::hypot(north, east);
  double const off = std::atan(1.5 * (distance - radius) / radius);
  double const course = std::atan2(east, north) + sense * (std::numbers::pi / 2.0 + off);
  double const speed = body.ground_speed_m_s();
  double const near = distance < 2.0 * radius ? sense * speed * speed / radius : 0.0;
  return {pace.speed_m_s, bank_for(geo::wrap_pi(course - course_rad(body)), body, near),
          climb_for(circle.center.down, body, pace)};
}

WingDemand climb_out(TakeOff const& take_off, Body const& body, Pace const& pace) {
  if (body.on_ground) return {pace.speed_m_s, 0.0, 1.0};
  double const error = geo::wrap_pi(take_off.heading_rad - course_rad(body));
  double const bank = std::clamp(bank_for(error, body), -0.25, 0.25);
  return {pace.speed_m_s, body.height_m() > 5.0 ? bank : 0.0, climb_for(-take_off.height_m - 5.0, body, pace)};
}

/// Glides straight to the point, flares over it, rolls out.
WingDemand land(Descend const& descend, Body const& body, Airframe const& airframe) {
  if (body.on_ground) return {0.0, 0.0, 0.0};
  double const north = descend.point.north - body.position_m.north;
  double const east = descend.point.east - body.position_m.east;
  double const approach_m_s = 1.3 * airframe.min_airspeed_m_s;
  double const distance = std::hypot(north, east);
  double const error = geo::wrap_pi(std::atan2(east, north) - course_rad(body));
  if (body.height_m() < flare_height_m) return {airframe.min_airspeed_m_s, 0.0, -flare_sink_m_s};
  bool const passed = std::abs(error) > std::numbers::pi / 2.0 && distance < 150.0;
  double const time_left = std::max(distance, 1.0) / std::max(body.ground_speed_m_s(), 5.0);
  double const sink = passed ? 2.5 : std::clamp(body.height_m() / time_left, 0.3, airframe.max_sink_m_s);
  return {approach_m_s, passed ? 0.0 : bank_for(error, body), -sink};
}

WingDemand cruise(Cruise const& wanted, Body const& body, Pace const& pace) {
  auto const& v = wanted.velocity_m_s;
  bool const has_course = std::hypot(v.north, v.east) > 1.0;
  double const error = has_course ? geo::wrap_pi(std::atan2(v.east, v.north) - course_rad(body)) : 0.0;
  return {pace.speed_m_s, bank_for(error, body), std::clamp(-v.down, -pace.sink_m_s, pace.climb_m_s)};
}

}  // namespace

Demand steer_wing(Goal const& goal, Body const& body, Airframe const& airframe, Pace const& pace) {
  if (auto const* take_off = std::get_if<TakeOff>(&goal)) return climb_out(*take_off, body, pace);
  if (auto const* descend = std::get_if<Descend>(&goal)) return land(*descend, body, airframe);
  if (std::holds_alternative<Idle>(goal)) return WingDemand{};
  if (std::holds_alternative<Sink>(goal)) return WingDemand{pace.speed_m_s, 0.0, body.on_ground ? 0.0 : -1.0};
  if (body.on_ground) return WingDemand{};
  if (auto const* hold = std::get_if<HoldAt>(&goal)) return around({hold->point, pace.loiter_radius_m}, body, pace);
  if (auto const* circle = std::get_if<Circle>(&goal)) return around(*circle, body, pace);
  if (auto const* way = std::get_if<FlyTo>(&goal)) return along(*way, body, pace);
  if (auto const* wanted = std::get_if<Cruise>(&goal)) return cruise(*wanted, body, pace);
  return WingDemand{};
}

}  // namespace lapwing::sim
