#pragma once

#include <vector>

#include "slam/graph.hpp"
#include "slam/log/scan_log.hpp"

namespace lapwing::slam {

/// How key frames of one drive fit where another one went.
struct FitOnMap {
  int met = 0;      ///< of them, taken within a metre of the other's
  int fitting = 0;  ///< of these, with most points on walls of the other's map

  [[nodiscard]] double share() const { return met == 0 ? 0.0 : static_cast<double>(fitting) / met; }
};

/// Half a building laid on the other half fits at its corners and along its corridors, and not in between. `seen`: the
/// scans that the other map is drawn of, taken at `poses`; `frames`: of the graph, those that are asked for.
[[nodiscard]] FitOnMap fit_on_map(ScanLog const& seen, std::vector<Pose2> const& poses, Graph const& graph,
                                  std::vector<int> const& frames);

}  // namespace lapwing::slam
