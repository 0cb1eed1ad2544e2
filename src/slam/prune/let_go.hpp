#pragma once

#include <utility>
#include <vector>

#include "slam/graph.hpp"
#include "slam/prune/redundant.hpp"

namespace lapwing::slam {

/// What became of a graph's key frames when some were let go.
struct Renumbering {
  static constexpr int gone = -1;
  std::vector<int> now;  ///< of each key frame its new number, or `gone`
  struct Inheritance {
    int heir = 0;   ///< by its new number; of a key frame that stays itself
    Pose2 in_heir;  ///< the key frame's pose in the heir's frame
  };
  std::vector<Inheritance> inheritances;  ///< of each key frame

  [[nodiscard]] bool stays(int frame) const { return now[frame] != gone; }
};

/// Takes key frames out of a graph, and what they knew of others into constraints between these. Precondition: what
/// `redundant_frames` found in it.
[[nodiscard]] Renumbering let_go(Graph& graph, std::vector<Redundant> const& redundant, int most_loops);

/// The elements that belong to key frames that stay.
template <class T>
void keep_staying(std::vector<T>& of_frames, Renumbering const& renumbering) {
  std::vector<T> left;
  for (std::size_t k = 0; k < of_frames.size(); ++k)
    if (renumbering.stays(static_cast<int>(k))) left.push_back(std::move(of_frames[k]));
  of_frames = std::move(left);
}

}  // namespace lapwing::slam
