#pragma once

#include <optional>
#include <variant>

#include "geo/position.hpp"
#include "sim/body/dynamics.hpp"

namespace lapwing::sim {

/// What the autopilot wants the vehicle to do until further notice. Points are in the site's frame.

/// Motors stopped.
struct StandStill {};
/// Motors turning at idle, not flying; wheels at rest.
struct Idle {};
/// Stay at a point: hover, stop, or for a wing circle it.
struct HoldAt {
  geo::Ned point;
};
/// Go to a point; `passing` when the way goes on behind it, so there is no need to stop.
struct FlyTo {
  geo::Ned point;
  geo::Ned from;  ///< start of the leg, whose line is kept
  bool passing = false;
};
/// Circle a point: clockwise seen from above for a positive radius.
struct Circle {
  geo::Ned center;
  double radius_m = 0.0;
};
/// Straight up over `from` to `height_m` above the ground of the site; a wing climbs out along `heading_rad`.
struct TakeOff {
  geo::Ned from;
  double height_m = 0.0;
  double heading_rad = 0.0;
};
/// Sink to the ground at a point; a wing glides there from where it is.
struct Descend {
  geo::Ned point;
};
/// Keep a velocity.
struct Cruise {
  geo::Ned velocity_m_s;
};
/// On wheels: a speed ahead, or backwards below zero, and a turn rate clockwise.
struct Steer {
  double speed_m_s = 0.0;
  double turn_rate_rad_s = 0.0;
};
/// Sink steadily with level attitude: what a rotorcraft does in a pilot-flown mode while the throttle stick is down.
struct Sink {
  double speed_m_s = 2.5;
};
using Goal = std::variant<StandStill, Idle, HoldAt, FlyTo, Circle, TakeOff, Descend, Cruise, Steer, Sink>;

/// How briskly goals are pursued: the vehicle's speed parameters, SI.
struct Pace {
  double speed_m_s = 10.0;
  double climb_m_s = 2.5;
  double sink_m_s = 1.5;
  double land_m_s = 0.5;
  double land_slow_below_m = 10.0;
  double accel_m_s2 = 2.5;
  double vertical_accel_m_s2 = 1.0;
  double loiter_radius_m = 60.0;       ///< of a wing that holds at a point
  std::optional<double> yaw_rad = {};  ///< heading wanted by command; empty: along the way
};

/// The demand that brings `body` closer to `goal`. Pure.
[[nodiscard]] Demand steer(Goal const& goal, Body const& body, Airframe const& airframe, Pace const& pace);

/// Where a body comes to rest when it brakes now; for a wing, which cannot, where it is.
[[nodiscard]] geo::Ned stopping_point(Body const& body, Airframe const& airframe, Pace const& pace);

/// True when a wing or wheels have gone past `point` on the leg from `from`, or anything is within `radius_m` of it.
[[nodiscard]] bool has_reached(Body const& body, geo::Ned from, geo::Ned point, double radius_m);

}  // namespace lapwing::sim
