#pragma once

#include "geo/position.hpp"
#include "plan/performance.hpp"

namespace lapwing::plan {

/// Time and length of one leg, and how it was left.
struct LegFlown {
  double time_s = 0.0;
  double path_m = 0.0;  ///< along the ground
};

/// A vehicle on paper that stops and turns: speed along the leg follows a trapezium.
/// `entry_m_s` may be negative, for who still moves away from the leg.
[[nodiscard]] double leg_time_s(double length_m, double entry_m_s, double exit_m_s, Performance const& performance);
/// The same upwards (positive) or downwards, from rest to rest.
[[nodiscard]] double vertical_time_s(double up_m, Performance const& performance);

/// A vehicle on paper that has to keep moving: flies curves no tighter than its turn rate allows.
class Curves {
 public:
  Curves(Performance const& performance, double heading_rad)
      : turn_rate_rad_s_(performance.turn_rate_rad_s), course_rad_(heading_rad), speed_m_s_(performance.cruise_m_s) {}

  void set_speed(double speed_m_s) { speed_m_s_ = speed_m_s; }
  /// Flies on straight.
  LegFlown straight(double time_s);
  /// Flies towards `goal` until it is within `radius_m` of it, or has passed it.
  LegFlown go_to(geo::Ned goal, double radius_m);

  [[nodiscard]] geo::Ned place() const { return at_; }
  void put(geo::Ned place) { at_ = place; }

 private:
  void step(double turn_rate_rad_s, double dt_s);

  double turn_rate_rad_s_;
  double course_rad_;
  double speed_m_s_;
  geo::Ned at_;
};

}  // namespace lapwing::plan
