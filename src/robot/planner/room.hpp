#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "robot/planner/way.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::robot {

/// How far the robot could go straight on, in any direction, before it touched something that its laser saw; of a few
/// sonars or single rangers, what they saw in the last two seconds. A wall that a sonar passes by is taken to go on a
/// little: those that look ahead do not hear it aslant. It knows nothing of the map: what a loop has shifted there
/// stands here where it stands.
class Room {
 public:
  /// Nobody has looked: there is none.
  Room() = default;
  Room(slam::Scan const& scan, slam::Sensor const& sensor) { take(scan, sensor); }
  /// What is seen now. Precondition: one and the same sensor always.
  void take(slam::Scan const& scan, slam::Sensor const& sensor);

  /// The same, as it is from where the robot has come by now.
  [[nodiscard]] Room seen_from(slam::Pose2 const& odometry) const;
  /// Towards `bearing`, for a disc of that radius, at most `most_m`. Negative: something is nearer than that already.
  [[nodiscard]] double towards(double bearing, double radius_m, double most_m = 2.0) const;

 private:
  slam::Pose2 from_;  ///< by odometry
  struct End {
    Eigen::Vector2d at;  ///< in the frame of a robot there
    slam::LogTime seen;
    std::size_t beam;
    bool is_guess;
  };
  void guess_how_walls_go_on(std::size_t heard, slam::LogTime now);
  std::vector<End> ends_;
  double looks_rad_ = -1.0;  ///< to both sides of where it looked; none before it has
  double looked_to_ = 0.0;   ///< the direction that was ahead then
};

}  // namespace lapwing::robot
