#pragma once

#include <deque>

#include "slam/pose2.hpp"

namespace lapwing::robot {

/// Whether the wheels turn and the robot stays where it is, as before a pane of glass that it pushes against: no sensor
/// feels that, but the scans go on to say the same.
class WheelSpin {
 public:
  /// Where it is by its wheels and by its map, at one moment. True: its wheels spin; so it stays until they drive it
  /// again, or `forget`.
  [[nodiscard]] bool feed(double time_s, slam::Pose2 const& by_wheels, slam::Pose2 const& on_map);
  void forget();

 private:
  struct Moment {
    double time_s = 0.0;
    slam::Pose2 by_wheels;
    slam::Pose2 on_map;
  };
  std::deque<Moment> lately_;
  bool is_spinning_ = false;
};

}  // namespace lapwing::robot
