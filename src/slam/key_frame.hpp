#pragma once

#include "slam/pose2.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

/// A scan that the map is made of: one every few decimetres or degrees.
struct KeyFrame {
  int scan = 0;  ///< of the log
  Frame frame;
  double path_m = 0.0;  ///< driven since the first one, by odometry
  /// Not taken on the way on from the one before it in the graph, as another drive begins here.
  bool is_cut = false;
};

/// A measured relative pose of two key frames, and how sure it is: H of Gauss-Newton in the frame of `from`.
struct Constraint {
  int from = 0;
  int to = 0;
  Pose2 from_to;  ///< of `to` in the frame of `from`
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  bool is_loop = false;  ///< found by search, so it may be wrong
};

}  // namespace lapwing::slam
