#include "slam/prune/let_go.hpp"

#include <utility>

#include "slam/graph/marginalize.hpp"

namespace lapwing::slam {
namespace {

Renumbering renumbering_of(Graph const& graph, std::vector<Redundant> const& redundant) {
  Renumbering renumbering;
  renumbering.now.assign(graph.frames.size(), 0);
  for (auto const& one : redundant) renumbering.now[one.frame] = Renumbering::gone;
  int next = 0;
  for (auto& now : renumbering.now)
    if (now != Renumbering::gone) now = next++;
  renumbering.inheritances.resize(graph.frames.size());
  for (int k = 0; k < graph.size(); ++k) renumbering.inheritances[k].heir = renumbering.now[k];
  for (auto const& [frame, heir] : redundant)
    renumbering.inheritances[frame] = {.heir = renumbering.now[heir],
                                       .in_heir = between(graph.poses[heir], graph.poses[frame])};
  return renumbering;
}

/// Where what lay between two key frames is gone, the later one does not follow on the earlier one any more.
void mark_cuts(Graph& graph, Renumbering const& renumbering) {
  constexpr double most_step_m = 1.0;
  int last = 0;
  for (int k = 1; k < graph.size(); ++k) {
    if (!renumbering.stays(k)) continue;
    if (k - last > 1 && distance_m(graph.poses[last], graph.poses[k]) > most_step_m) graph.frames[k].is_cut = true;
    last = k;
  }
}

}  // namespace

Renumbering let_go(Graph& graph, std::vector<Redundant> const& redundant, int most_loops) {
  auto renumbering = renumbering_of(graph, redundant);
  std::vector<bool> goes;
  for (int k = 0; k < graph.size(); ++k) goes.push_back(!renumbering.stays(k));
  for (auto const& one : redundant)
    graph.constraints = marginalized(graph.constraints, graph.poses, one.frame, goes, most_loops);
  for (auto& constraint : graph.constraints) {
    constraint.from = renumbering.now[constraint.from];
    constraint.to = renumbering.now[constraint.to];
  }
  mark_cuts(graph, renumbering);
  keep_staying(graph.frames, renumbering);
  keep_staying(graph.poses, renumbering);
  return renumbering;
}

}  // namespace lapwing::slam
