#include <algorithm>
#include <cmath>

#include "sim/guidance/guidance.hpp"

namespace lapwing::sim {

namespace {

constexpr double position_gain_per_s = 1.0;
/// Stopping is planned with less than the full acceleration, so that the lag of tilting does not end in an overshoot.
constexpr double stopping_share = 0.7;

double vertical(double distance_down, Pace const& pace) {
  double const speed = closing_speed(distance_down, position_gain_per_s, stopping_share * pace.vertical_accel_m_s2);
  return std::clamp(speed, -pace.climb_m_s, pace.sink_m_s);
}

RotorDemand towards(geo::Ned point, Body const& body, Pace const& pace, double least_speed = 0.0) {
  double const north = point.north - body.position_m.north;
  double const east = point.east - body.position_m.east;
  double const distance = std::hypot(north, east);
  double const stopping = closing_speed(distance, position_gain_per_s, stopping_share * pace.accel_m_s2);
  double const speed = std::min(pace.speed_m_s, std::max(least_speed, stopping));
  RotorDemand demand{.velocity_m_s = {0.0, 0.0, vertical(point.down - body.position_m.down, pace)},
                     .yaw_rad = pace.yaw_rad,
                     .accel_m_s2 = pace.accel_m_s2,
                     .vertical_accel_m_s2 = pace.vertical_accel_m_s2};
  if (distance > 1e-6) {
    demand.velocity_m_s.north = speed * north / distance;
    demand.velocity_m_s.east = speed * east / distance;
  }
  // The nose turns to the next waypoint; close to it the bearing says nothing.
  if (!demand.yaw_rad && distance > 2.0) demand.yaw_rad = std::atan2(east, north);
  return demand;
}

RotorDemand around(Circle const& circle, Body const& body, Pace const& pace) {
  double const north = body.position_m.north - circle.center.north;
  double const east = body.position_m.east - circle.center.east;
  double const distance = std::hypot(north, east);
  double const radius = std::max(1.0, std::abs(circle.radius_m));
  if (distance > 3.0 * radius || distance < 0.1) {
    return towards({circle.center.north + radius, circle.center.east, circle.center.down}, body, pace);
  }
  // Centripetal acceleration bounds the speed; the radial error is closed like any other distance.
  double const speed = std::min(pace.speed_m_s, std::sqrt(0.6 * pace.accel_m_s2 * radius));
  double const inward = std::clamp(distance - radius + speed * speed / radius / 3.0, -speed, speed);
  double const sense = circle.radius_m < 0.0 ? -1.0 : 1.0;
  double const un = north / distance;
  double const ue = east / distance;
  RotorDemand demand = towards(circle.center, body, pace);
  demand.velocity_m_s.north = -inward * un - sense * speed * ue;
  demand.velocity_m_s.east = -inward * ue + sense * speed * un;
  return demand;
}

RotorDemand sink(geo::Ned over, Body const& body, Pace const& pace) {
  RotorDemand demand = towards(over, body, pace);
  demand.velocity_m_s.down = body.height_m() > pace.land_slow_below_m ? pace.sink_m_s : pace.land_m_s;
  demand.yaw_rad = pace.yaw_rad;
  return demand;
}

}  // namespace

Demand steer_rotor(Goal const& goal, Body const& body, Pace const& pace) {
  if (auto const* hold = std::get_if<HoldAt>(&goal)) return towards(hold->point, body, pace);
  if (auto const* way = std::get_if<FlyTo>(&goal)) {
    // A waypoint that is only passed is not braked for fully: corners are cut at half speed. Who has yet to climb to it
    // waits for that on the spot instead of circling.
    constexpr double about_level_m = 5.0;
    bool const passes = way->passing && std::abs(way->point.down - body.position_m.down) < about_level_m;
    return towards(way->point, body, pace, passes ? 0.5 * pace.speed_m_s : 0.0);
  }
  if (auto const* circle = std::get_if<Circle>(&goal)) return around(*circle, body, pace);
  if (auto const* take_off = std::get_if<TakeOff>(&goal)) {
    return towards({take_off->from.north, take_off->from.east, -take_off->height_m}, body, pace);
  }
  if (auto const* descend = std::get_if<Descend>(&goal)) return sink(descend->point, body, pace);
  if (auto const* cruise = std::get_if<Cruise>(&goal)) {
    return RotorDemand{cruise->velocity_m_s, pace.yaw_rad, pace.accel_m_s2, pace.vertical_accel_m_s2};
  }
  if (auto const* fall = std::get_if<Sink>(&goal)) {
    return RotorDemand{{0.0, 0.0, fall->speed_m_s}, pace.yaw_rad, pace.accel_m_s2, pace.vertical_accel_m_s2};
  }
  return RotorDemand{};
}

}  // namespace lapwing::sim
