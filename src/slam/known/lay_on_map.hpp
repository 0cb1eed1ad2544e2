#pragma once

#include "slam/known/known_map.hpp"
#include "slam/match/align.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

/// How a scan lies on a known map.
struct Laid {
  Pose2 pose;
  double fit = 0.0;  ///< the share of its points that lie within 15 cm of a wall of the map; 0 where it has none
};

/// The share of the points within 15 cm of a wall.
[[nodiscard]] double fit_of(KnownMap const& map, Frame const& frame, Pose2 const& pose);

/// Downhill from `start` until the points lie on the walls as well as they can, held to the prior: Gauss-Newton on the
/// distances to the walls, of which large ones count less and less.
[[nodiscard]] Laid lay_on_map(KnownMap const& map, Frame const& frame, Pose2 const& start, Prior const& prior);

}  // namespace lapwing::slam
