#pragma once

#include "sim/flight_context.hpp"

namespace lapwing::sim {

/// Lands at a point and notices the end: on the ground for a second.
class Landing {
 public:
  explicit Landing(geo::Ned point) : point_(point) {}
  Goal update(FlightContext const& context);
  [[nodiscard]] bool finished() const { return finished_; }

 private:
  geo::Ned point_;
  std::optional<base::Duration> grounded_at_;
  bool finished_ = false;
};

/// The way home. A copter climbs to the return height, flies back, waits, lands. A plane flies back at the return
/// height and circles there for good. A rover drives back and stops.
class ReturnHome {
 public:
  Goal update(FlightContext const& context);
  /// Landed (copter) or arrived (rover); never for a plane.
  [[nodiscard]] bool finished() const { return phase_ == Phase::done; }

 private:
  enum class Phase { start, climb, travel, wait, land, done };
  Goal begin(FlightContext const& context);
  Goal fly(FlightContext const& context);

  Phase phase_ = Phase::start;
  geo::Ned start_;
  geo::Ned above_home_;  ///< or above the rally point
  base::Duration waiting_since_{};
  std::optional<Landing> landing_;
};

}  // namespace lapwing::sim
