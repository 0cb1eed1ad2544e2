#include "slam/loops/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace lapwing::slam {
namespace {

using Adjacency = std::vector<std::vector<char>>;

struct Tolerance {
  double shift_m;
  double turn_rad;
};

Tolerance tolerance(Drift const& of_queries, Drift const& of_targets) {
  // What two alignments of one place differ by, and two standard deviations of the way between.
  constexpr double alignment_m = 0.25;
  constexpr double alignment_rad = 0.03;
  constexpr double deviations = 2.0;
  return {alignment_m + deviations * std::hypot(of_queries.shift_m, of_targets.shift_m),
          alignment_rad + deviations * std::hypot(of_queries.turn_rad, of_targets.turn_rad)};
}

bool agree(Graph const& graph, Closure const& a, Closure const& b, Tolerance const& tolerance) {
  constexpr double meaningless_m = 1.25;
  if (tolerance.shift_m > meaningless_m) return false;
  auto const by_a = claimed_pose(graph, a) * between(graph.poses[a.query], graph.poses[b.query]);
  auto const by_b = claimed_pose(graph, b);
  return distance_m(by_a, by_b) < tolerance.shift_m && turn_rad(by_a, by_b) < tolerance.turn_rad;
}

Adjacency adjacency_of(Graph const& graph, std::vector<Closure> const& closures, DriftRates const& rates) {
  std::map<int, std::vector<Drift>> drifts;
  auto const drift_of = [&](int from) -> std::vector<Drift> const& {
    auto& drift = drifts[from];
    if (drift.empty()) drift = drift_from(from, graph.poses, graph.constraints, rates);
    return drift;
  };
  Adjacency adjacency(closures.size(), std::vector<char>(closures.size(), 0));
  for (std::size_t i = 0; i < closures.size(); ++i) {
    auto const& of_queries = drift_of(closures[i].query);
    auto const& of_targets = drift_of(closures[i].target);
    for (std::size_t j = 0; j < i; ++j) {
      auto const& other = closures[j];
      if (other.query == closures[i].query) continue;  // what is said twice by one place is said once
      auto const allowed = tolerance(of_queries[other.query], of_targets[other.target]);
      adjacency[i][j] = adjacency[j][i] = agree(graph, closures[i], other, allowed) ? 1 : 0;
    }
  }
  return adjacency;
}

/// Of those that are still there, grown from each of them in turn by whoever agrees with most.
std::vector<int> largest_clique(Adjacency const& adjacency, std::vector<int> const& members) {
  std::map<int, int> degree;
  for (auto const i : members)
    degree[i] = static_cast<int>(std::ranges::count_if(members, [&](int j) { return adjacency[i][j] != 0; }));
  auto order = members;
  std::ranges::sort(order, {}, [&](int i) { return std::pair(-degree[i], i); });
  std::vector<int> largest;
  for (auto const seed : order) {
    if (static_cast<std::size_t>(degree[seed]) + 1 <= largest.size()) break;
    std::vector<int> clique{seed};
    for (auto const i : order)
      if (i != seed && std::ranges::all_of(clique, [&](int c) { return adjacency[i][c] != 0; })) clique.push_back(i);
    if (clique.size() > largest.size()) largest = std::move(clique);
  }
  return largest;
}

}  // namespace

Pose2 claimed_pose(Graph const& graph, Closure const& closure) {
  return graph.poses[closure.target] * closure.target_to_query;
}

std::vector<std::vector<int>> consistent_groups(Graph const& graph, std::vector<Closure> const& closures,
                                                DriftRates const& rates) {
  auto const adjacency = adjacency_of(graph, closures, rates);
  std::vector<int> left(closures.size());
  std::iota(left.begin(), left.end(), 0);
  std::vector<std::vector<int>> groups;
  while (!left.empty()) {
    groups.push_back(largest_clique(adjacency, left));
    std::erase_if(left, [&](int i) { return std::ranges::find(groups.back(), i) != groups.back().end(); });
  }
  return groups;
}

}  // namespace lapwing::slam
