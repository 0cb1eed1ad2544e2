#include "slam/graph/pose_graph.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "slam/graph/block_system.hpp"
#include "slam/graph/relative_pose.hpp"

namespace lapwing::slam {
namespace {

/// How much a loop with that squared error counts, and what it costs then.
struct Scaling {
  double weight = 1.0;
  double cost = 0.0;
};

Scaling scaling(Constraint const& constraint, double squared, double tolerance) {
  if (!constraint.is_loop || tolerance <= 0.0) return {1.0, squared};
  auto const s = std::min(1.0, 2.0 * tolerance / (tolerance + squared));
  return {s * s, s * s * squared + tolerance * (1.0 - s) * (1.0 - s)};
}

double cost_of(std::vector<Constraint> const& constraints, std::vector<Pose2> const& poses, double tolerance) {
  double sum = 0.0;
  for (auto const& constraint : constraints)
    sum += scaling(constraint, squared_error(constraint, poses), tolerance).cost;
  return sum;
}

/// H and b of all constraints at these poses.
void fill(BlockSystem& system, std::vector<Constraint> const& constraints, std::vector<Pose2> const& poses,
          double tolerance) {
  system.set_zero();
  for (auto const& constraint : constraints) {
    auto const& from = poses[constraint.from];
    auto const& to = poses[constraint.to];
    auto const error = error_of(constraint, poses);
    auto const weight = scaling(constraint, error.dot(constraint.information * error), tolerance).weight;
    Eigen::Matrix3d const information = weight * constraint.information;
    auto const [by_from, by_to] = relative_pose_slopes(from, to);
    Eigen::Matrix3d const from_part = by_from.transpose() * information;
    Eigen::Matrix3d const to_part = by_to.transpose() * information;
    system.add(constraint.from, from_part * by_from, from_part * error);
    system.add(constraint.to, to_part * by_to, to_part * error);
    system.add_coupling(constraint.from, constraint.to, from_part * by_to);
  }
  system.fix(0);
}

std::vector<Pose2> moved(std::vector<Pose2> const& poses, Eigen::VectorXd const& step) {
  auto result = poses;
  for (std::size_t k = 0; k < poses.size(); ++k)
    result[k] = stepped(poses[k], step.segment<3>(3 * static_cast<Eigen::Index>(k)));
  return result;
}

}  // namespace

Eigen::Vector3d error_of(Constraint const& constraint, std::vector<Pose2> const& poses) {
  auto const measured = between(poses[constraint.from], poses[constraint.to]);
  Eigen::Vector3d error = numbers(measured) - numbers(constraint.from_to);
  error.z() = geo::wrap_pi(error.z());
  return error;
}

double squared_error(Constraint const& constraint, std::vector<Pose2> const& poses) {
  auto const error = error_of(constraint, poses);
  return error.dot(constraint.information * error);
}

double squared_error(std::vector<Constraint> const& constraints, std::vector<Pose2> const& poses) {
  double sum = 0.0;
  for (auto const& constraint : constraints) sum += squared_error(constraint, poses);
  return sum;
}

PoseGraphResult optimize(std::vector<Pose2> poses, std::vector<Constraint> const& constraints,
                         PoseGraphOptions const& options) {
  PoseGraphResult result;
  if (poses.empty()) return result;
  BlockSystem::Couples couples;
  for (auto const& constraint : constraints) couples.emplace_back(constraint.from, constraint.to);
  BlockSystem system(static_cast<int>(poses.size()), std::move(couples));
  auto cost = cost_of(constraints, poses, options.loop_tolerance);
  double damping = 1e-8;
  while (result.rounds < options.most_rounds && damping < 1e8) {
    ++result.rounds;
    fill(system, constraints, poses, options.loop_tolerance);
    auto const solution = system.solve(damping);
    if (!solution.is_valid) {
      damping = std::max(damping * 10.0, 1e-6);
      continue;
    }
    auto tried = moved(poses, solution.step);
    auto const tried_cost = cost_of(constraints, tried, options.loop_tolerance);
    if (tried_cost > cost) {
      damping = std::max(damping * 10.0, 1e-6);
      if (solution.step.lpNorm<Eigen::Infinity>() < options.small_step) break;
      continue;
    }
    auto const gain = cost - tried_cost;
    poses = std::move(tried);
    cost = tried_cost;
    damping *= 0.1;
    if (solution.step.lpNorm<Eigen::Infinity>() < options.small_step || gain < options.small_gain * cost) break;
  }
  result.squared_error = squared_error(constraints, poses);
  result.poses = std::move(poses);
  return result;
}

}  // namespace lapwing::slam
