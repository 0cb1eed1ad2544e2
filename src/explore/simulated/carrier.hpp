#pragma once

#include <functional>
#include <vector>

#include "explore/floor/dense_grid.hpp"
#include "explore/path/motion.hpp"

namespace lapwing::explore {

/// A differential drive within its limits: speeds change no faster than it can accelerate, and between two moments it
/// drives an arc.
class Carrier {
 public:
  Carrier(Pose pose, CarrierLimits const& limits) : limits_(limits), pose_(pose) {}

  [[nodiscard]] Pose const& pose() const { return pose_; }
  [[nodiscard]] Motion const& motion() const { return motion_; }
  [[nodiscard]] double driven_m() const { return driven_m_; }

  /// Where it comes if it brakes now, a place each `seconds`.
  [[nodiscard]] std::vector<Place> braking_places(double seconds) const;
  /// Does for `seconds` what is wanted as far as it can. `is_safe(place)` is asked for everywhere it would come if it
  /// braked right after: where one is not, it brakes now. So it always can.
  void drive(Motion wanted, double seconds, std::function<bool(Place const&)> const& is_safe);

 private:
  struct State {
    Pose pose;
    Motion motion;
  };
  [[nodiscard]] State after(State const& state, Motion wanted, double seconds) const;

  CarrierLimits limits_;
  Pose pose_;
  Motion motion_;
  double driven_m_ = 0.0;
};

}  // namespace lapwing::explore
