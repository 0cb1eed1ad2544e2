#pragma once

#include <cstddef>

#include "robot/planner/room.hpp"
#include "robot/planner/way.hpp"

namespace lapwing::robot {

/// Follows a way from reading to reading: pure pursuit (Coulter 1992) of a point a little ahead on it, turning on the
/// spot where it bends sharply, slower the nearer something stands before it, and not nearer to that than the safe
/// distance with the way to brake counted. Where the way leads nearer to something than its map has it, the robot goes
/// by the nearest direction in which there is room (after VFH, Borenstein & Koren 1991).
class Follower {
 public:
  explicit Follower(Limits const& limits) : limits_(limits) {}

  void take(Way way);
  void stop() { take({}); }
  [[nodiscard]] Way const& way() const { return way_; }
  /// At the end of a way that leads to its goal.
  [[nodiscard]] bool has_arrived() const { return has_arrived_; }

  /// `room`: as it is from where it is now.
  [[nodiscard]] Motion steer(slam::Pose2 const& pose, Room const& room);

 private:
  [[nodiscard]] Motion along(slam::Pose2 const& pose, Room const& room, double most_m_s);
  [[nodiscard]] double free_bearing(double wanted, double far_m, Room const& room);

  Limits limits_;
  Way way_;
  std::size_t at_ = 0;  ///< of the points, what has been passed
  bool has_arrived_ = false;
  double shuns_to_ = 1.0;  ///< the side to which it last went by something
};

}  // namespace lapwing::robot
