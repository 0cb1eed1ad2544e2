#pragma once

#include <optional>
#include <variant>

#include "sim/guidance/flight_context.hpp"

namespace lapwing::sim {

/// GUIDED: goes where the ground says, holds when it has nothing to do.
class Guided {
 public:
  explicit Guided(geo::Ned here) : goal_(HoldAt{here}) {}

  /// Climbs to `height_m` above home, straight up.
  void take_off(geo::Ned from, double height_m, double heading_rad) { goal_ = TakeOff{from, height_m, heading_rad}; }
  void go_to(geo::Ned from, geo::Ned point) { goal_ = FlyTo{point, from, false}; }
  void circle(geo::Ned center, double radius_m) { goal_ = Circle{center, radius_m}; }
  /// Good for the guided time-out.
  void set_velocity(geo::Ned velocity_m_s, base::Duration now);
  /// Likewise.
  void steer(Steer const& wanted, base::Duration now);
  void pause(geo::Ned here);
  void resume();

  Goal update(FlightContext const& context);

 private:
  Goal goal_;
  std::optional<Goal> paused_;
  base::Duration velocity_set_at_{};
};

}  // namespace lapwing::sim
