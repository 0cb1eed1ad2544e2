#pragma once

#include "slam/graph.hpp"
#include "slam/loops/agreement.hpp"
#include "slam/parallel.hpp"

namespace lapwing::slam {

/// What key frames say of each other that come to lie together at `poses` and did not at `before`, or lay there
/// otherwise: passes of the robot at least `apart_m` from each other. A false loop lays rooms upon each other whose
/// walls stand where the others saw free space, and not only at the place that it was found at.
[[nodiscard]] Agreement agreement_of_passes(Graph const& graph, std::vector<Pose2> const& poses,
                                            std::vector<Pose2> const& before, double apart_m, ForEach const& for_each);

}  // namespace lapwing::slam
