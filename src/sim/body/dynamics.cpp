#include "sim/body/dynamics.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

namespace lapwing::sim {

namespace {

constexpr double gravity_m_s2 = 9.80665;
/// How fast a rotorcraft's acceleration follows what is asked: the time to tilt.
constexpr double tilt_time_s = 0.15;
constexpr double velocity_gain_per_s = 3.0;
/// Drag of a small quadrotor that makes it lean into the wind: acceleration per m/s of air speed.
constexpr double drag_per_s = 0.15;

geo::Ned operator+(geo::Ned a, geo::Ned b) {
  return {a.north + b.north, a.east + b.east, a.down + b.down};
}
geo::Ned operator*(geo::Ned a, double k) {
  return {a.north * k, a.east * k, a.down * k};
}

double approach(double value, double target, double most) {
  return value + std::clamp(target - value, -most, most);
}

geo::Ned limit_horizontal(geo::Ned v, double most) {
  double const length = std::hypot(v.north, v.east);
  if (length <= most) return v;
  return {v.north * most / length, v.east * most / length, v.down};
}

/// Puts a body that has sunk to the ground on it, noting how hard; wheels and rotors stop there, wings keep rolling.
Body meet_ground(Body body, bool keeps_rolling) {
  if (body.position_m.down < 0.0) {
    body.on_ground = false;
    return body;
  }
  if (!body.on_ground) body.touch_down_m_s = std::max(0.0, body.velocity_m_s.down);
  body.on_ground = true;
  body.position_m.down = 0.0;
  body.velocity_m_s.down = std::min(body.velocity_m_s.down, 0.0);
  if (!keeps_rolling) {
    body.velocity_m_s = {};
    body.accel_m_s2 = {};
  }
  return body;
}

Body stand(Body body) {
  body.velocity_m_s = {};
  body.accel_m_s2 = {};
  body.attitude.roll_rad = 0.0;
  body.attitude.pitch_rad = 0.0;
  body.yaw_rate_rad_s = 0.0;
  return body;
}

Body turn_towards(Body body, double yaw_rad, double max_rate, double dt) {
  double const error = geo::wrap_pi(yaw_rad - body.attitude.yaw_rad);
  double const rate = std::clamp(2.0 * error, -max_rate, max_rate);
  body.yaw_rate_rad_s = approach(body.yaw_rate_rad_s, rate, 3.0 * dt);
  body.attitude.yaw_rad = geo::wrap_pi(body.attitude.yaw_rad + body.yaw_rate_rad_s * dt);
  return body;
}

/// Tilt that yields the horizontal acceleration against drag, in the body's heading.
Body lean(Body body, geo::Ned wind) {
  double const north = body.accel_m_s2.north + drag_per_s * (body.velocity_m_s.north - wind.north);
  double const east = body.accel_m_s2.east + drag_per_s * (body.velocity_m_s.east - wind.east);
  double const c = std::cos(body.attitude.yaw_rad);
  double const s = std::sin(body.attitude.yaw_rad);
  body.attitude.pitch_rad = -std::atan2(north * c + east * s, gravity_m_s2);
  body.attitude.roll_rad = std::atan2(-north * s + east * c, gravity_m_s2);
  return body;
}

/// What holds in air and water: the velocity follows what is asked, within the bounds of the airframe.
Body thrust(Body body, RotorDemand const& demand, Airframe const& airframe, double dt) {
  auto const wanted = limit_horizontal(demand.velocity_m_s, airframe.max_speed_m_s);
  geo::Ned const& v = body.velocity_m_s;
  geo::Ned ask{(wanted.north - v.north) * velocity_gain_per_s, (wanted.east - v.east) * velocity_gain_per_s, 0.0};
  ask = limit_horizontal(ask, std::min(demand.accel_m_s2, airframe.max_accel_m_s2));
  double const down = std::clamp(wanted.down, -airframe.max_climb_m_s, airframe.max_sink_m_s);
  double const most = std::min(demand.vertical_accel_m_s2, airframe.max_vertical_accel_m_s2);
  ask.down = std::clamp((down - v.down) * velocity_gain_per_s, -most, most);

  double const follow = dt / (tilt_time_s + dt);
  body.accel_m_s2 = body.accel_m_s2 * (1.0 - follow) + ask * follow;
  body.velocity_m_s = body.velocity_m_s + body.accel_m_s2 * dt;
  body.position_m = body.position_m + body.velocity_m_s * dt;
  return turn_towards(body, demand.yaw_rad.value_or(body.attitude.yaw_rad), airframe.max_turn_rate_rad_s, dt);
}

Body step_rotor(Body const& body, RotorDemand const& demand, Airframe const& airframe, geo::Ned wind, double dt) {
  if (body.on_ground && demand.velocity_m_s.down >= 0.0) return stand(body);
  return meet_ground(lean(thrust(body, demand, airframe, dt), wind), false);
}

/// No wind and no current under water. It is a little lighter than water: without thrust it comes up.
Body step_hull(Body body, std::optional<RotorDemand> const& demand, Airframe const& airframe, double dt) {
  constexpr double buoyant_climb_m_s = 0.2;
  body = thrust(body, demand.value_or(RotorDemand{.velocity_m_s = {0.0, 0.0, -buoyant_climb_m_s}, .yaw_rad = {}}),
                airframe, dt);
  if (body.position_m.down < 0.0) {
    body.position_m.down = 0.0;
    body.velocity_m_s.down = std::max(body.velocity_m_s.down, 0.0);
  }
  constexpr double afloat_m = 0.05;
  body.on_ground = body.position_m.down < afloat_m;
  body.airspeed_m_s = body.ground_speed_m_s();
  return body;
}

Body fall(Body body, geo::Ned wind, double dt) {
  if (body.on_ground) return stand(body);
  // Terminal speed about 25 m/s; the wind carries it.
  double const drag = gravity_m_s2 / (25.0 * 25.0);
  body.accel_m_s2 = {(wind.north - body.velocity_m_s.north) * drag_per_s,
                     (wind.east - body.velocity_m_s.east) * drag_per_s,
                     gravity_m_s2 - drag * body.velocity_m_s.down * std::abs(body.velocity_m_s.down)};
  body.velocity_m_s = body.velocity_m_s + body.accel_m_s2 * dt;
  body.position_m = body.position_m + body.velocity_m_s * dt;
  return meet_ground(body, false);
}

/// On the runway: straight ahead, off the ground once there is speed to fly and a wish to climb.
Body roll_on_runway(Body body, WingDemand const& demand, Airframe const& airframe, double dt) {
  double const rate = demand.airspeed_m_s > body.airspeed_m_s ? airframe.max_accel_m_s2 : 3.0;
  body.airspeed_m_s = approach(body.airspeed_m_s, std::max(0.0, demand.airspeed_m_s), rate * dt);
  double const yaw = body.attitude.yaw_rad;
  body.velocity_m_s = {body.airspeed_m_s * std::cos(yaw), body.airspeed_m_s * std::sin(yaw), 0.0};
  body.attitude.roll_rad = 0.0;
  body.attitude.pitch_rad = 0.0;
  body.yaw_rate_rad_s = 0.0;
  if (demand.climb_m_s > 0.0 && body.airspeed_m_s >= 1.2 * airframe.min_airspeed_m_s) {
    body.on_ground = false;
    body.velocity_m_s.down = -0.2;
  }
  body.position_m = body.position_m + body.velocity_m_s * dt;
  return body;
}

Body step_wing(Body body, WingDemand const& demand, Airframe const& airframe, geo::Ned wind, double dt) {
  if (body.on_ground) return roll_on_runway(body, demand, airframe, dt);
  double const airspeed = std::clamp(demand.airspeed_m_s, airframe.min_airspeed_m_s, airframe.max_speed_m_s);
  body.airspeed_m_s = approach(body.airspeed_m_s, airspeed, airframe.max_accel_m_s2 * dt);
  double const bank = std::clamp(demand.bank_rad, -airframe.max_bank_rad, airframe.max_bank_rad);
  body.attitude.roll_rad = approach(body.attitude.roll_rad, bank, airframe.max_bank_rate_rad_s * dt);
  // A coordinated turn: the horizontal part of lift is the centripetal force.
  body.yaw_rate_rad_s = gravity_m_s2 * std::tan(body.attitude.roll_rad) / std::max(body.airspeed_m_s, 5.0);
  body.attitude.yaw_rad = geo::wrap_pi(body.attitude.yaw_rad + body.yaw_rate_rad_s * dt);

  double climb = std::clamp(demand.climb_m_s, -airframe.max_sink_m_s, airframe.max_climb_m_s);
  if (body.airspeed_m_s < airframe.min_airspeed_m_s) climb = std::min(climb, -2.0);
  double const up = approach(-body.velocity_m_s.down, climb, airframe.max_vertical_accel_m_s2 * dt);
  double const yaw = body.attitude.yaw_rad;
  geo::Ned const before = body.velocity_m_s;
  body.velocity_m_s = {body.airspeed_m_s * std::cos(yaw) + wind.north, body.airspeed_m_s * std::sin(yaw) + wind.east,
                       -up};
  body.accel_m_s2 = (body.velocity_m_s + before * -1.0) * (1.0 / dt);
  body.attitude.pitch_rad = std::atan2(up, std::max(body.airspeed_m_s, 5.0)) + 0.03;
  body.position_m = body.position_m + body.velocity_m_s * dt;
  return meet_ground(body, true);
}

Body glide(Body const& body, Airframe const& airframe, geo::Ned wind, double dt) {
  if (!body.on_ground) return step_wing(body, {1.3 * airframe.min_airspeed_m_s, 0.0, -2.5}, airframe, wind, dt);
  return roll_on_runway(body, {0.0, 0.0, 0.0}, airframe, dt);
}

Body step_wheels(Body body, WheelDemand const& demand, Airframe const& airframe, double dt) {
  double const yaw = body.attitude.yaw_rad;
  double const now = body.velocity_m_s.north * std::cos(yaw) + body.velocity_m_s.east * std::sin(yaw);
  double const wanted = std::clamp(demand.speed_m_s, -airframe.max_speed_m_s, airframe.max_speed_m_s);
  double const speed = approach(now, wanted, airframe.max_accel_m_s2 * dt);
  // Sideways grip: 0.6 g, as ArduRover's ATC_TURN_MAX_G.
  double const grip = 0.6 * gravity_m_s2 / std::max(std::abs(speed), 0.5);
  double const most = std::min(airframe.max_turn_rate_rad_s, grip);
  body.yaw_rate_rad_s = approach(body.yaw_rate_rad_s, std::clamp(demand.turn_rate_rad_s, -most, most), 4.0 * dt);
  body.attitude.yaw_rad = geo::wrap_pi(yaw + body.yaw_rate_rad_s * dt);
  double const after = body.attitude.yaw_rad;
  geo::Ned const before = body.velocity_m_s;
  body.velocity_m_s = {speed * std::cos(after), speed * std::sin(after), 0.0};
  body.accel_m_s2 = (body.velocity_m_s + before * -1.0) * (1.0 / dt);
  body.position_m = body.position_m + body.velocity_m_s * dt;
  body.airspeed_m_s = std::abs(speed);
  return body;
}

}  // namespace

double Body::ground_speed_m_s() const {
  return std::hypot(velocity_m_s.north, velocity_m_s.east);
}

Airframe airframe_of(vehicle::Family family) {
  using enum vehicle::Family;
  if (family == plane) {
    return {.family = plane,
            .max_speed_m_s = 30.0,
            .min_airspeed_m_s = 10.0,
            .max_climb_m_s = 5.0,
            .max_sink_m_s = 5.0,
            .max_accel_m_s2 = 4.0,
            .max_vertical_accel_m_s2 = 4.0,
            .max_turn_rate_rad_s = 1.0};
  }
  if (family == rover || family == boat) {
    return {.family = rover,
            .floats = family == boat,
            .max_speed_m_s = 6.0,
            .max_climb_m_s = 0.0,
            .max_sink_m_s = 0.0,
            .max_accel_m_s2 = 2.0};
  }
  if (family == sub) {
    return {.family = sub,
            .floats = true,
            .max_speed_m_s = 2.0,
            .max_climb_m_s = 0.8,
            .max_sink_m_s = 0.8,
            .max_accel_m_s2 = 0.6,
            .max_vertical_accel_m_s2 = 0.4,
            .max_turn_rate_rad_s = 0.8};
  }
  LAPWING_ASSERT(family == copter, family);
  return {};
}

Body step(Body const& body, Demand const& demand, Airframe const& airframe, geo::Ned wind_m_s, double dt_s) {
  LAPWING_ASSERT(dt_s > 0.0 && dt_s <= 0.1, dt_s);
  Body start = body;
  start.touch_down_m_s.reset();
  if (airframe.family == vehicle::Family::sub) {
    auto const* thrusters = std::get_if<RotorDemand>(&demand);
    return step_hull(start, thrusters ? std::optional(*thrusters) : std::nullopt, airframe, dt_s);
  }
  if (auto const* rotor = std::get_if<RotorDemand>(&demand)) {
    start = step_rotor(start, *rotor, airframe, wind_m_s, dt_s);
  } else if (auto const* wing = std::get_if<WingDemand>(&demand)) {
    return step_wing(start, *wing, airframe, wind_m_s, dt_s);
  } else if (auto const* wheels = std::get_if<WheelDemand>(&demand)) {
    return step_wheels(start, *wheels, airframe, dt_s);
  } else if (airframe.family == vehicle::Family::plane) {
    return glide(start, airframe, wind_m_s, dt_s);
  } else if (airframe.family == vehicle::Family::rover) {
    return step_wheels(start, {}, airframe, dt_s);
  } else {
    start = fall(start, wind_m_s, dt_s);
  }
  start.airspeed_m_s = std::hypot(start.velocity_m_s.north - wind_m_s.north, start.velocity_m_s.east - wind_m_s.east);
  return start;
}

}  // namespace lapwing::sim
