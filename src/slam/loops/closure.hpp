#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "slam/graph.hpp"
#include "slam/loops/agreement.hpp"
#include "slam/loops/branch_and_bound.hpp"
#include "slam/loops/loop_options.hpp"

namespace lapwing::slam {

/// Some consecutive key frames as one cloud with its pyramid, in the frame of the middle one.
struct Submap {
  int reference = 0;
  int first = 0;
  int last = 0;
  Pyramid pyramid;
};
/// Of the key frames from `first` to `last`; nothing when they saw too little.
[[nodiscard]] std::optional<Submap> make_submap(Graph const& graph, int first, int last);

/// The points of the key frames up to `last`, in its frame, thinned to one each 0.2 m.
[[nodiscard]] std::vector<Eigen::Vector2f> query_cloud(Graph const& graph, int last, int frames);

/// That the robot, at key frame `query`, was where `target` is near: found, aligned and looked at, not yet believed.
struct Closure {
  int target = 0;
  int query = 0;
  Pose2 target_to_query;
  Eigen::Matrix3d information;  ///< in the target's frame
  double score = 0.0;
  double rival = 0.0;
  int matches = 0;  ///< points of the one on lines of the other
  Agreement agreement;
  double window_m = 0.0;
  double deviations = 0.0;   ///< standard ones of the drift between the two, of x, y and yaw together
  bool is_expected = false;  ///< it is not near the limit of what is believed at all
  int record = 0;            ///< of the closer's records

  /// Whether enough points match, and the two did not see through each other's walls.
  [[nodiscard]] bool fits(LoopOptions const& options) const {
    return matches >= options.least_matches && agreement.conflict() <= options.most_conflict;
  }
  [[nodiscard]] Constraint constraint() const {
    return {.from = target, .to = query, .from_to = target_to_query, .information = information, .is_loop = true};
  }
};

/// Aligns the query's key frames to the submap's, point to line, from where the search found them.
[[nodiscard]] Closure make_closure(Graph const& graph, Submap const& submap, int query, LoopMatch const& match,
                                   LoopOptions const& options);

}  // namespace lapwing::slam
