#pragma once

#include <vector>

#include "slam/graph.hpp"
#include "slam/prune/prune_options.hpp"

namespace lapwing::slam {

/// A key frame whose viewpoint later passes have seen often enough.
struct Redundant {
  int frame = 0;
  /// Of those seen from there one that stays, in the middle of all: the newest may have drifted, with no loop closed
  /// yet.
  int heir = 0;

  friend bool operator==(Redundant const&, Redundant const&) = default;
};

/// All of them, ascending; never the first key frame, which holds the map's frame. The newest passes stay, so that a
/// map of a building in which things are moved shows it as it is.
[[nodiscard]] std::vector<Redundant> redundant_frames(Graph const& graph, PruneOptions const& options);

}  // namespace lapwing::slam
