#pragma once

#include "slam/pose2.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

/// What two scans say of each other when they are laid together: each point of one lies where the other saw a wall,
/// in space that the other saw to be free, or out of its sight.
struct Agreement {
  int on_wall = 0;
  int in_free_space = 0;
  int out_of_sight = 0;

  Agreement& operator+=(Agreement const& other) {
    on_wall += other.on_wall;
    in_free_space += other.in_free_space;
    out_of_sight += other.out_of_sight;
    return *this;
  }
  [[nodiscard]] int seen() const { return on_wall + in_free_space; }
  /// Of the points that the other could see; 0 when there are none.
  [[nodiscard]] double conflict() const { return seen() == 0 ? 0.0 : static_cast<double>(in_free_space) / seen(); }
};

/// The points of either against the beams of the other.
[[nodiscard]] Agreement agreement(Frame const& a, Pose2 const& a_pose, Frame const& b, Pose2 const& b_pose);

}  // namespace lapwing::slam
