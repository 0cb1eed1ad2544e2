#include "slam/refine/joint.hpp"

#include <algorithm>
#include <cmath>

#include "slam/graph/relative_pose.hpp"
#include "slam/refine/overlap.hpp"

namespace lapwing::slam {
namespace {

Eigen::Vector3d trust_in(Pose2 const& step, StepSpread const& spread) {
  auto const length_m = std::hypot(step.x, step.y);
  auto const shift_m = spread.shift_m + spread.shift_per_m * length_m;
  auto const turn_rad = spread.turn_rad + spread.turn_per_m * length_m + spread.turn_per_rad * std::abs(step.yaw);
  return {1.0 / (shift_m * shift_m), 1.0 / (shift_m * shift_m), 1.0 / (turn_rad * turn_rad)};
}

}  // namespace

std::vector<JointAlignment::Pair> JointAlignment::overlapping(Graph const& graph, JointOptions const& options) {
  auto const in_time = options.in_time;
  PlaceIndex const index(graph.poses, options.radius_m, in_time);
  std::vector<Pair> pairs;
  for (int k = 0; k < graph.size(); ++k) {
    for (int back : {1, 2, 4})
      if (k >= back) pairs.push_back({k, k - back});
    for (auto const j : index.near(graph.poses[k], k, options.neighbours, options.apart_m))
      if (std::abs(j - k) > in_time || j > k) pairs.push_back({k, j});
  }
  return pairs;
}

BlockSystem JointAlignment::system_for(Graph const& graph, std::vector<Pair> const& pairs) {
  BlockSystem::Couples couples;
  for (auto const& pair : pairs) couples.emplace_back(pair.source, pair.target);
  for (int k = 1; k < graph.size(); ++k) couples.emplace_back(k - 1, k);
  return {graph.size(), std::move(couples)};
}

JointAlignment::JointAlignment(Graph graph, JointOptions const& options, std::vector<HeldHeading> headings)
    : options_(options),
      graph_(std::move(graph)),
      before_(graph_.poses),
      headings_(std::move(headings)),
      pairs_(overlapping(graph_, options)),
      terms_(pairs_.size()),
      system_(system_for(graph_, pairs_)) {
  if (graph_.size() < 2) round_ = options_.rounds;
}

Association JointAlignment::association() const {
  auto const share = options_.rounds > 1 ? static_cast<double>(round_) / (options_.rounds - 1) : 1.0;
  return {.gate_m = options_.first_gate_m * std::pow(options_.last_gate_m / options_.first_gate_m, share),
          .scale_m = options_.first_scale_m * std::pow(options_.last_scale_m / options_.first_scale_m, share),
          .stride = round_ + 2 < options_.rounds ? options_.first_stride : 1};
}

void JointAlignment::go_on(std::size_t most_pairs, ForEach const& for_each) {
  auto const now = association();
  auto const count = std::min(most_pairs, pairs_.size() - next_);
  for_each(count, [&](std::size_t i) {
    auto const [source, target] = pairs_[next_ + i];
    terms_[next_ + i] = point_to_line(graph_.frames[source].frame, graph_.poses[source], graph_.frames[target].frame,
                                      graph_.poses[target], now);
  });
  next_ += count;
  if (next_ == pairs_.size()) move_all();
}

/// That neighbours in time stay about where the graph had put them to each other: what holds a key frame that sees
/// little.
void JointAlignment::hold_steps() {
  auto const& poses = graph_.poses;
  for (int k = 1; k < static_cast<int>(poses.size()); ++k) {
    constexpr double over_a_cut = 0.01;  // so that what sees nothing stays, and nothing else is held by it
    auto const was = between(before_[k - 1], before_[k]);
    Eigen::Vector3d const trust = (graph_.frames[k].is_cut ? over_a_cut : 1.0) * trust_in(was, options_.steps);
    auto const& from = poses[k - 1];
    auto const& to = poses[k];
    Eigen::Vector3d error = numbers(between(from, to)) - numbers(was);
    error.z() = geo::wrap_pi(error.z());
    auto const [by_from, by_to] = relative_pose_slopes(from, to);
    system_.add(k - 1, by_from.transpose() * trust.asDiagonal() * by_from,
                by_from.transpose() * trust.cwiseProduct(error));
    system_.add(k, by_to.transpose() * trust.asDiagonal() * by_to, by_to.transpose() * trust.cwiseProduct(error));
    system_.add_coupling(k - 1, k, by_from.transpose() * trust.asDiagonal() * by_to);
  }
}

void JointAlignment::hold_headings() {
  for (auto const& [frame, heading] : headings_) {
    auto const trust = 1.0 / (heading.sigma_rad * heading.sigma_rad);
    auto const off_rad = geo::wrap_pi(graph_.poses[static_cast<std::size_t>(frame)].yaw - heading.yaw_rad);
    system_.add(frame, Eigen::Vector3d(0.0, 0.0, trust).asDiagonal(), Eigen::Vector3d(0.0, 0.0, trust * off_rad));
  }
}

void JointAlignment::move_all() {
  auto const point_information = association().stride * options_.point_information;
  system_.set_zero();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    if (!terms_[i].is_usable()) continue;
    auto const [source, target] = pairs_[i];
    Eigen::Matrix<double, 6, 6> const hessian = point_information * terms_[i].hessian;
    Eigen::Matrix<double, 6, 1> const gradient = point_information * terms_[i].gradient;
    system_.add(source, hessian.topLeftCorner<3, 3>(), gradient.head<3>());
    system_.add(target, hessian.bottomRightCorner<3, 3>(), gradient.tail<3>());
    system_.add_coupling(source, target, hessian.topRightCorner<3, 3>());
  }
  hold_steps();
  hold_headings();
  system_.fix(0);
  next_ = 0;
  auto const solution = system_.solve();
  if (!solution.is_valid) {  // what there is stands
    round_ = options_.rounds;
    return;
  }
  for (int k = 0; k < graph_.size(); ++k) graph_.poses[k] = stepped(graph_.poses[k], solution.step.segment<3>(3L * k));
  ++round_;
}

void refine_jointly(Graph& graph, JointOptions const& options, ForEach const& for_each) {
  constexpr auto all = static_cast<std::size_t>(-1);
  JointAlignment alignment(std::move(graph), options);
  while (!alignment.is_done()) alignment.go_on(all, for_each);
  graph = std::move(alignment).take();
}

}  // namespace lapwing::slam
