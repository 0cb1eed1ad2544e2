#pragma once

#include <cstddef>

#include "robot/planner/way.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// How far the robot could go straight on before it touched something. Negative: something is nearer than that already.
struct Room {
  double ahead_m = 0.0;
  double behind_m = 0.0;
};

/// Follows a way from reading to reading: pure pursuit (Coulter 1992) of a point a little ahead on it, turning on the
/// spot where it bends sharply, slower the nearer something stands before it, and not nearer to that than the safe
/// distance with the way to brake counted.
class Follower {
 public:
  explicit Follower(Limits const& limits) : limits_(limits) {}

  void take(Way way);
  void stop() { take({}); }
  [[nodiscard]] Way const& way() const { return way_; }
  /// At the end of a way that leads to its goal.
  [[nodiscard]] bool has_arrived() const { return has_arrived_; }

  [[nodiscard]] Motion steer(slam::Pose2 const& pose, Room const& room);

 private:
  [[nodiscard]] Motion along(slam::Pose2 const& pose, double most_m_s);

  Limits limits_;
  Way way_;
  std::size_t at_ = 0;  ///< of the points, what has been passed
  bool has_arrived_ = false;
};

/// Of a disc of a little more than the robot's size, before one of the scan's ends is within it; at most `most_m`.
/// Nothing behind where the sensor does not look back.
[[nodiscard]] Room room_of(slam::Scan const& scan, slam::Sensor const& sensor, Limits const& limits,
                           double most_m = 2.0);

}  // namespace lapwing::robot
