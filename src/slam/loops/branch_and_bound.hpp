#pragma once

#include <optional>

#include "slam/loops/pyramid.hpp"
#include "slam/pose2.hpp"

namespace lapwing::slam {

struct LoopWindow {
  Pose2 guess;  ///< of the query, in the pyramid's frame
  double reach_m = 1.0;
  double reach_rad = 0.1;
  /// How far off the guess may be, one standard deviation; a pose that is farther off must fit better.
  double sigma_m = 1e9;
  double sigma_rad = 1e9;
  /// So many parts of it are looked into at most: a wide window over ground that looks alike everywhere has no end.
  int most_branches = 200'000;
};

struct LoopMatch {
  Pose2 pose;
  double score = 0.0;  ///< mean over the points, 0 to 1, less what it costs to be far from the guess
  /// Of the best pose that is another place altogether, or what bounds it from above; where it is about as high as
  /// `score`, the building looks alike in both.
  double rival = 0.0;
  bool is_at_edge = false;  ///< of the window, so that the best one may lie beyond it
};

/// The pose of the window at which the points lie best on the pyramid's, in steps of 0.1 m and 1 degree, by what the
/// guess lets expect; nothing when at none so large a share as `least_score` lies on them.
[[nodiscard]] std::optional<LoopMatch> branch_and_bound(Pyramid const& pyramid,
                                                        std::vector<Eigen::Vector2f> const& query,
                                                        LoopWindow const& window, double least_score);

}  // namespace lapwing::slam
