#pragma once

#include <vector>

#include "slam/key_frame.hpp"

namespace lapwing::slam {

/// The constraints without that key frame, its neighbours joined by what they knew of each other over it. Of all trees
/// over the neighbours it is the one that loses least (Kullback and Leibler's divergence from what the key frame's
/// constraints say of them): a spanning tree of the largest information (Chow and Liu 1968; Kretzschmar and Stachniss
/// 2012, section IV). Constraints that are no loops stay a path between whatever they joined. Loops that are open at
/// these poses, or beyond the `most_loops` best of a neighbour, are left out.
///
/// `goes`: of each key frame, whether it is to go, too. Those that stay are joined with each other first: a loop that
/// is handed on along steps, whose frames go one after the other, says less and less, until nothing holds what it held.
[[nodiscard]] std::vector<Constraint> marginalized(std::vector<Constraint> const& constraints,
                                                   std::vector<Pose2> const& poses, int frame,
                                                   std::vector<bool> const& goes, int most_loops);

}  // namespace lapwing::slam
