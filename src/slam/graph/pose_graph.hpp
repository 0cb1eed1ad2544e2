#pragma once

#include <vector>

#include "slam/key_frame.hpp"

namespace lapwing::slam {

struct PoseGraphOptions {
  int most_rounds = 100;
  /// Loops whose squared error is far above this count less (dynamic covariance scaling, Agarwal et al. 2013, eq. 15);
  /// 0: all count in full.
  double loop_tolerance = 0.0;
  double small_step = 1e-6;  ///< metres and radians: good enough
  double small_gain = 1e-9;  ///< a round that lowers the cost by less than this share was the last
};

struct PoseGraphResult {
  std::vector<Pose2> poses;
  double squared_error = 0.0;  ///< sum of e^T Omega e over all constraints, none scaled down
  int rounds = 0;
};

/// How far the poses are from what the constraint measured.
[[nodiscard]] Eigen::Vector3d error_of(Constraint const& constraint, std::vector<Pose2> const& poses);
[[nodiscard]] double squared_error(Constraint const& constraint, std::vector<Pose2> const& poses);
[[nodiscard]] double squared_error(std::vector<Constraint> const& constraints, std::vector<Pose2> const& poses);

/// The poses that agree best with the constraints, from `poses` downhill (Levenberg-Marquardt; Grisetti et al. 2010,
/// A Tutorial on Graph-Based SLAM). The first pose stays.
[[nodiscard]] PoseGraphResult optimize(std::vector<Pose2> poses, std::vector<Constraint> const& constraints,
                                       PoseGraphOptions const& options = {});

}  // namespace lapwing::slam
