#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "slam/log/scan_log.hpp"

/// How good a trajectory is, by true relative poses of pairs of moments (Kuemmerle et al. 2009).
namespace lapwing::slam {

/// Where the robot truly was at the second time, in its frame at the first.
struct Relation {
  LogTime first{0.0};
  LogTime second{0.0};
  Pose2 motion;
};

/// Lines of `t1 t2 x y z roll pitch yaw`; `#` begins a comment. Errors: invalid_input, with the line.
[[nodiscard]] base::Result<std::vector<Relation>> read_relations(std::string_view text);

/// Of the absolute errors.
struct Spread {
  double mean = 0.0;
  double deviation = 0.0;  ///< by N - 1
  double mean_square = 0.0;
  double most = 0.0;
};
struct RelationErrors {
  Spread shift_m;
  Spread turn_deg;
};

struct TimedPose {
  LogTime time{0.0};
  Pose2 pose;
};

/// As the Freiburg metricEvaluator counts: differences of the components, each time's nearest pose. Precondition: poses
/// in order of time, at least one.
[[nodiscard]] RelationErrors component_errors(std::span<TimedPose const> trajectory,
                                              std::span<Relation const> relations);
/// As Cartographer counts: of the motion that is left, poses interpolated. Precondition: likewise.
[[nodiscard]] RelationErrors motion_errors(std::span<TimedPose const> trajectory, std::span<Relation const> relations);

}  // namespace lapwing::slam
