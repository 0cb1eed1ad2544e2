#include "slam/refine/joint.hpp"

#include <cmath>

#include "slam/graph/block_system.hpp"
#include "slam/graph/relative_pose.hpp"
#include "slam/match/point_to_line.hpp"
#include "slam/refine/overlap.hpp"

namespace lapwing::slam {
namespace {

struct Pair {
  int source;
  int target;
};

std::vector<Pair> overlapping(Graph const& graph, JointOptions const& options) {
  auto const in_time = options.in_time;
  PlaceIndex const index(graph.poses, options.radius_m, in_time);
  std::vector<Pair> pairs;
  for (int k = 0; k < graph.size(); ++k) {
    for (int back : {1, 2, 4})
      if (k >= back) pairs.push_back({k, k - back});
    for (auto const j : index.near(graph.poses[k], k, options.neighbours))
      if (std::abs(j - k) > in_time || j > k) pairs.push_back({k, j});
  }
  return pairs;
}

/// That neighbours in time stay about where the graph had put them to each other: what holds a key frame that sees
/// little.
void hold_steps(BlockSystem& system, std::vector<Pose2> const& before, Graph const& graph, double scale) {
  auto const& poses = graph.poses;
  for (int k = 1; k < static_cast<int>(poses.size()); ++k) {
    constexpr double over_a_cut = 0.01;  // so that what sees nothing stays, and nothing else is held by it
    Eigen::Vector3d const trust =        // 5 cm, 1.1 degrees
        (graph.frames[k].is_cut ? over_a_cut : 1.0) * scale * Eigen::Vector3d(400.0, 400.0, 2500.0);
    auto const& from = poses[k - 1];
    auto const& to = poses[k];
    Eigen::Vector3d error = numbers(between(from, to)) - numbers(between(before[k - 1], before[k]));
    error.z() = geo::wrap_pi(error.z());
    auto const [by_from, by_to] = relative_pose_slopes(from, to);
    system.add(k - 1, by_from.transpose() * trust.asDiagonal() * by_from,
               by_from.transpose() * trust.cwiseProduct(error));
    system.add(k, by_to.transpose() * trust.asDiagonal() * by_to, by_to.transpose() * trust.cwiseProduct(error));
    system.add_coupling(k - 1, k, by_from.transpose() * trust.asDiagonal() * by_to);
  }
}

}  // namespace

void refine_jointly(Graph& graph, JointOptions const& options, ForEach const& for_each) {
  if (graph.size() < 2) return;
  auto const pairs = overlapping(graph, options);
  BlockSystem::Couples couples;
  for (auto const& pair : pairs) couples.emplace_back(pair.source, pair.target);
  for (int k = 1; k < graph.size(); ++k) couples.emplace_back(k - 1, k);
  BlockSystem system(graph.size(), std::move(couples));
  auto const before = graph.poses;
  std::vector<PairTerm> terms(pairs.size());
  for (int round = 0; round < options.rounds; ++round) {
    auto const share = options.rounds > 1 ? static_cast<double>(round) / (options.rounds - 1) : 1.0;
    Association const association{
        .gate_m = options.first_gate_m * std::pow(options.last_gate_m / options.first_gate_m, share),
        .scale_m = options.first_scale_m * std::pow(options.last_scale_m / options.first_scale_m, share),
        .stride = round + 2 < options.rounds ? options.first_stride : 1};
    auto const point_information = association.stride * options.point_information;
    for_each(pairs.size(), [&](std::size_t i) {
      auto const [source, target] = pairs[i];
      terms[i] = point_to_line(graph.frames[source].frame, graph.poses[source], graph.frames[target].frame,
                               graph.poses[target], association);
    });
    system.set_zero();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!terms[i].is_usable()) continue;
      auto const [source, target] = pairs[i];
      Eigen::Matrix<double, 6, 6> const hessian = point_information * terms[i].hessian;
      Eigen::Matrix<double, 6, 1> const gradient = point_information * terms[i].gradient;
      system.add(source, hessian.topLeftCorner<3, 3>(), gradient.head<3>());
      system.add(target, hessian.bottomRightCorner<3, 3>(), gradient.tail<3>());
      system.add_coupling(source, target, hessian.topRightCorner<3, 3>());
    }
    hold_steps(system, before, graph, options.step_trust);
    system.fix(0);
    auto const solution = system.solve();
    if (!solution.is_valid) return;
    for (int k = 0; k < graph.size(); ++k) graph.poses[k] = stepped(graph.poses[k], solution.step.segment<3>(3L * k));
  }
}

}  // namespace lapwing::slam
