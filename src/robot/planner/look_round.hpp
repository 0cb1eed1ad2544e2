#pragma once

#include <optional>

#include "explore/known/known_map.hpp"

namespace lapwing::robot {

/// Has a robot that sees little at a time, as by a few sonars, turn once round on the spot where much about it is
/// unknown, and not twice at the same place.
class LookRound {
 public:
  /// It has come to where it wanted to.
  void arrive(explore::KnownMap const& map, explore::Pose const& pose);
  void stop() { turns_left_ = 0; }
  /// Ten scans a second leave no gaps then, two metres off.
  static constexpr double turn_rad_s = 0.25;
  /// Which way to turn next; nothing: it has no reason to, or has come round.
  [[nodiscard]] std::optional<double> next(double yaw_rad);

 private:
  std::optional<explore::Place> looked_at_;  ///< where it turned last
  int turns_left_ = 0;                       ///< parts of a whole turn
  double towards_rad_ = 0.0;
};

}  // namespace lapwing::robot
