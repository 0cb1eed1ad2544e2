#pragma once

#include <vector>

#include "slam/key_frame.hpp"

namespace lapwing::slam {

/// How far two key frames' relative pose may be off, by the graph between them.
struct Drift {
  double shift_m = 1e9;  ///< standard deviation, of the worse axis
  double turn_rad = 1e9;
  double path_m = 1e9;  ///< along the constraints
  /// Of x, y and yaw along the map's axes, of the key frame as seen from `origin`: m^2, m rad, rad^2.
  Eigen::Matrix3d covariance = 1e18 * Eigen::Matrix3d::Identity();
};

struct DriftRates {
  double shift_per_sqrt_m = 0.03;  ///< of one metre driven
  double turn_per_sqrt_m = 0.006;  ///< radians
  double turn_per_rad = 0.01;      ///< radians of each radian turned
  /// A step's turn errs by that much of the deviation that its information leaves, if that is more: what no scan saw is
  /// as odometry told it. `edge_share` has it some three times as unsure as it is, so this is all of it.
  double unseen_share = 0.3;
  double loop_shift_m = 0.05;  ///< of a closure
  double loop_turn_rad = 0.005;
};

/// The drift of each key frame against `origin`: what the errors of single steps, of a turn at each place on the way,
/// add up to along the path that turns least surely known (Dijkstra over the graph, so an upper bound of what the
/// whole graph knows).
[[nodiscard]] std::vector<Drift> drift_from(int origin, std::vector<Pose2> const& poses,
                                            std::vector<Constraint> const& constraints, DriftRates const& rates);

}  // namespace lapwing::slam
