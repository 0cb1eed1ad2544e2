#pragma once

#include <vector>

#include "sim/guidance/flight_context.hpp"

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

/// The way home along the trail that led here (SMART_RTL). A copter stops 2 m above its beginning and lands; a rover
/// stops there.
class Retrace {
 public:
  /// `trail` from its beginning on.
  explicit Retrace(std::vector<geo::Ned> trail) : left_(std::move(trail)) {}
  Goal update(FlightContext const& context);
  /// Landed (copter) or arrived (rover).
  [[nodiscard]] bool finished() const { return finished_; }
  /// What has not been gone back yet.
  [[nodiscard]] std::vector<geo::Ned> const& left() const { return left_; }

 private:
  std::vector<geo::Ned> left_;
  std::optional<geo::Ned> from_;
  std::optional<Landing> landing_;
  bool finished_ = false;
};

}  // namespace lapwing::sim
