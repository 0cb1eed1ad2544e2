#pragma once

#include <span>
#include <vector>

#include "slam/pose2.hpp"

namespace lapwing::robot {

/// How a map has moved when it was drawn anew, by a loop or an alignment: each part of it went with the robot's way
/// through it. For what was placed on the map before, and is no part of it: signs on its walls.
class MapShift {
 public:
  /// Where the robot's key frames were and where they are, in the order of its way. Precondition: as many.
  MapShift(std::span<slam::Pose2 const> from, std::span<slam::Pose2 const> to);

  /// Where that is which was there: it goes with the nearest key frame, and stays where none is within 8 m.
  [[nodiscard]] slam::Pose2 moved(slam::Pose2 const& before) const;

 private:
  std::vector<slam::Pose2> from_;
  std::vector<slam::Pose2> to_;
};

}  // namespace lapwing::robot
