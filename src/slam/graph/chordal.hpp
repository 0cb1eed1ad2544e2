#pragma once

#include <vector>

#include "slam/key_frame.hpp"

namespace lapwing::slam {

/// Poses to begin with, from the constraints alone: first all directions as if their sines and cosines were free
/// numbers, then all places for these directions, each one linear system (Martinec and Pajdla 2007; Carlone et al.
/// 2015, Initialization Techniques for 3D SLAM). Odometry that has drifted for long may lie beyond another hill than
/// the best poses do; these do not. The first pose is as given. Precondition: the constraints join all poses.
[[nodiscard]] std::vector<Pose2> chordal_poses(std::size_t count, Pose2 const& first,
                                               std::vector<Constraint> const& constraints);

}  // namespace lapwing::slam
