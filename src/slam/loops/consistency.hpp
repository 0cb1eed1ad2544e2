#pragma once

#include <vector>

#include "slam/loops/closure.hpp"

namespace lapwing::slam {

/// Where the closure says that its query stands.
[[nodiscard]] Pose2 claimed_pose(Graph const& graph, Closure const& closure);

/// The closures in groups in which each agrees with every other, by number, the largest group first (pairwise
/// consistent measurements, Mangelson et al. 2018; the largest clique by a greedy search from every closure). Two agree
/// when they put the robot in one place, as well as the drift between their queries and between their targets lets it
/// be told; where that is a metre or more, they say nothing of each other.
[[nodiscard]] std::vector<std::vector<int>> consistent_groups(Graph const& graph, std::vector<Closure> const& closures,
                                                              DriftRates const& rates);

}  // namespace lapwing::slam
