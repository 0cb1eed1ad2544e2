#pragma once

#include <Eigen/Core>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// How the pose of `to` as seen from `from` changes with either of them, the derivatives of between(from, to): rows and
/// columns are x, y and yaw.
struct RelativePoseSlopes {
  Eigen::Matrix3d by_from;
  Eigen::Matrix3d by_to;
};

[[nodiscard]] inline RelativePoseSlopes relative_pose_slopes(Pose2 const& from, Pose2 const& to) {
  Turn const turn(from.yaw);
  Eigen::Vector2d const apart = place(to) - place(from);
  Eigen::Matrix3d by_to = Eigen::Matrix3d::Identity();
  by_to.topLeftCorner<2, 2>() << turn.cosine, turn.sine, -turn.sine, turn.cosine;
  Eigen::Matrix3d by_from = -by_to;
  by_from.block<2, 1>(0, 2) = turn.back({apart.y(), -apart.x()});
  return {.by_from = by_from, .by_to = by_to};
}

}  // namespace lapwing::slam
