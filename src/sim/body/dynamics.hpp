#pragma once

#include <optional>
#include <variant>

#include "geo/position.hpp"
#include "vehicle/aspects/motion.hpp"
#include "vehicle/family.hpp"

namespace lapwing::sim {

/// What a body of this kind can do. Speeds in m/s, accelerations in m/s², angles in radians.
struct Airframe {
  vehicle::Family family = vehicle::Family::copter;  ///< a boat's is `rover`: it runs that program and steers as one
  bool floats = false;
  double max_speed_m_s = 18.0;    ///< through the air for wings and rotors, over ground for wheels
  double min_airspeed_m_s = 0.0;  ///< a wing below it sinks; also the speed of lift-off
  double max_climb_m_s = 6.0;
  double max_sink_m_s = 6.0;
  double max_accel_m_s2 = 5.0;  ///< along the ground
  double max_vertical_accel_m_s2 = 2.5;
  double max_turn_rate_rad_s = 1.5;
  double max_bank_rad = 0.8;
  double max_bank_rate_rad_s = 1.2;
};

/// A quadrotor, a conventional aeroplane, a four-wheeled rover, a boat (steered like a rover), an underwater vehicle
/// with thrusters. Precondition: one of these five families.
[[nodiscard]] Airframe airframe_of(vehicle::Family family);

/// Where a body is and how it moves. Position and velocity in the world's local frame (north, east, down about its
/// anchor, velocity over ground); the ground, or the surface of the water, is the plane down = 0. Only an underwater
/// vehicle is below it.
struct Body {
  geo::Ned position_m;
  geo::Ned velocity_m_s;
  geo::Ned accel_m_s2;
  vehicle::Attitude attitude;
  double yaw_rate_rad_s = 0.0;
  double airspeed_m_s = 0.0;
  bool on_ground = true;  ///< afloat, of an underwater vehicle
  /// Vertical speed of the touch-down in this very step, if there was one.
  std::optional<double> touch_down_m_s;

  [[nodiscard]] double height_m() const { return -position_m.down; }
  [[nodiscard]] double ground_speed_m_s() const;
};

/// No thrust: stands on the ground, falls or glides in the air.
struct MotorsOff {};
/// A rotorcraft or an underwater vehicle asked for a velocity over ground and, if given, a heading.
struct RotorDemand {
  geo::Ned velocity_m_s;
  std::optional<double> yaw_rad;
  /// Bounds on the accelerations with which the velocity is reached; the airframe's own bounds hold too.
  double accel_m_s2 = 2.5;
  double vertical_accel_m_s2 = 1.5;
};
/// An aeroplane asked for an airspeed, a bank angle (positive: to the right) and a vertical speed (positive: up).
struct WingDemand {
  double airspeed_m_s = 0.0;
  double bank_rad = 0.0;
  double climb_m_s = 0.0;
};
/// A ground vehicle asked for a speed and a turn rate (positive: to the right).
struct WheelDemand {
  double speed_m_s = 0.0;
  double turn_rate_rad_s = 0.0;
};
using Demand = std::variant<MotorsOff, RotorDemand, WingDemand, WheelDemand>;

/// The body `dt_s` later. Pure: the same arguments give the same body, bit for bit, on one build.
/// Precondition: the demand suits the family (a WingDemand for a plane), 0 < dt_s <= 0.1.
[[nodiscard]] Body step(Body const& body, Demand const& demand, Airframe const& airframe, geo::Ned wind_m_s,
                        double dt_s);

}  // namespace lapwing::sim
