#include "slam/prune/redundant.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace lapwing::slam {
namespace {

/// Key frames that stay, the newest of each place first.
class Viewpoints {
 public:
  explicit Viewpoints(double near_m) : near_m_(near_m) {}

  void add(Pose2 const& pose, int frame) { cells_[cell(column(pose.x), column(pose.y))].push_back(frame); }

  /// Those around the pose, in order of time.
  [[nodiscard]] std::vector<int> around(Graph const& graph, Pose2 const& pose, PruneOptions const& options) const {
    std::vector<int> found;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        auto const at = cells_.find(cell(column(pose.x) + i, column(pose.y) + j));
        if (at == cells_.end()) continue;
        for (auto const frame : at->second) {
          auto const& other = graph.poses[frame];
          if (distance_m(pose, other) <= options.near_m && turn_rad(pose, other) <= options.near_rad)
            found.push_back(frame);
        }
      }
    }
    std::ranges::sort(found);
    return found;
  }

 private:
  [[nodiscard]] std::int64_t column(double metres) const {
    return static_cast<std::int64_t>(std::floor(metres / near_m_));
  }
  [[nodiscard]] static std::int64_t cell(std::int64_t x, std::int64_t y) { return x * 1'000'003 + y; }

  double near_m_;
  std::unordered_map<std::int64_t, std::vector<int>> cells_;
};

/// How many passes these are, of those after `frame`.
int passes_after(int frame, std::vector<int> const& seen, int apart_frames) {
  int passes = 0;
  auto last = frame;
  for (auto const other : seen) {
    if (other - last >= apart_frames) ++passes;
    last = other;
  }
  return passes;
}

}  // namespace

std::vector<Redundant> redundant_frames(Graph const& graph, PruneOptions const& options) {
  std::vector<Redundant> redundant;
  Viewpoints staying(options.near_m);
  for (int k = graph.size() - 1; k > 0; --k) {
    auto const& pose = graph.poses[k];
    if (k < graph.size() - options.fresh_frames) {
      auto const seen = staying.around(graph, pose, options);
      if (passes_after(k, seen, options.apart_frames) >= options.passes) {
        redundant.push_back({.frame = k, .heir = seen[seen.size() / 2]});
        continue;
      }
    }
    staying.add(pose, k);
  }
  std::ranges::reverse(redundant);
  return redundant;
}

}  // namespace lapwing::slam
