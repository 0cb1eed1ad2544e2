#include "slam/loops/contradiction.hpp"

#include <cmath>

#include "slam/refine/overlap.hpp"

namespace lapwing::slam {
namespace {

struct Pair {
  int a;
  int b;
};

std::vector<Pair> newly_together(Graph const& graph, std::vector<Pose2> const& poses, std::vector<Pose2> const& before,
                                 double apart_m) {
  constexpr int every = 4;  // key frames; the next sees the same
  constexpr int most_near = 6;
  constexpr double sight_m = 3.0;
  constexpr double moved_m = 0.25;
  constexpr double moved_rad = 0.05;
  PlaceIndex const index(poses, sight_m);
  std::vector<Pair> pairs;
  for (int k = 0; k < graph.size(); k += every) {
    for (auto const other : index.near(poses[k], k, most_near)) {
      if (std::abs(graph.frames[k].path_m - graph.frames[other].path_m) < apart_m) continue;
      auto const now = between(poses[k], poses[other]);
      auto const then = between(before[k], before[other]);
      if (distance_m(now, then) > moved_m || turn_rad(now, then) > moved_rad) pairs.push_back({k, other});
    }
  }
  return pairs;
}

}  // namespace

Agreement agreement_of_passes(Graph const& graph, std::vector<Pose2> const& poses, std::vector<Pose2> const& before,
                              double apart_m, ForEach const& for_each) {
  auto const pairs = newly_together(graph, poses, before, apart_m);
  std::vector<Agreement> each(pairs.size());
  for_each(pairs.size(), [&](std::size_t i) {
    auto const [a, b] = pairs[i];
    each[i] = agreement(graph.frames[a].frame, poses[a], graph.frames[b].frame, poses[b]);
  });
  Agreement sum;
  for (auto const& one : each) sum += one;
  return sum;
}

}  // namespace lapwing::slam
