#include "slam/graph/pose_graph.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "slam/graph/block_system.hpp"

namespace lapwing::slam {
namespace {

/// A ring of poses, each measured from the one before.
std::vector<Pose2> ring(int count, double radius) {
  std::vector<Pose2> poses;
  for (int k = 0; k < count; ++k) {
    auto const angle = 2.0 * 3.14159265358979 * k / count;
    poses.push_back({radius * std::sin(angle), radius * (1.0 - std::cos(angle)), geo::wrap_pi(angle)});
  }
  return poses;
}

std::vector<Constraint> steps_of(std::vector<Pose2> const& poses) {
  std::vector<Constraint> constraints;
  for (int k = 1; k < static_cast<int>(poses.size()); ++k)
    constraints.push_back({.from = k - 1,
                           .to = k,
                           .from_to = between(poses[k - 1], poses[k]),
                           .information = Eigen::Vector3d(100.0, 100.0, 400.0).asDiagonal()});
  return constraints;
}

Constraint loop(int from, int to, Pose2 const& motion) {
  return {.from = from,
          .to = to,
          .from_to = motion,
          .information = Eigen::Vector3d(500.0, 500.0, 2000.0).asDiagonal(),
          .is_loop = true};
}

TEST(BlockSystem, SolvesAsADenseSolverDoes) {
  std::mt19937 random(3);
  std::normal_distribution<double> number;
  constexpr int poses = 7;
  BlockSystem system(poses, {{0, 1}, {2, 1}, {5, 3}, {3, 5}, {6, 0}, {4, 2}});
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * poses, 3 * poses);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(3 * poses);
  for (int k = 0; k < poses; ++k) {
    Eigen::Matrix3d const block =
        20.0 * Eigen::Matrix3d::Identity() + Eigen::Vector3d(1, 2, 3) * Eigen::RowVector3d(1, 2, 3);
    Eigen::Vector3d const slope(number(random), number(random), number(random));
    system.add(k, block, slope);
    dense.block<3, 3>(3L * k, 3L * k) += block;
    gradient.segment<3>(3L * k) += slope;
  }
  for (auto const& [a, b] : {std::pair{0, 1}, {2, 1}, {5, 3}, {6, 0}, {4, 2}}) {
    Eigen::Matrix3d coupling;
    for (auto& value : coupling.reshaped()) value = number(random);
    system.add_coupling(a, b, coupling);
    dense.block<3, 3>(3L * a, 3L * b) += coupling;
    dense.block<3, 3>(3L * b, 3L * a) += coupling.transpose();
  }
  auto const solution = system.solve();
  ASSERT_TRUE(solution.is_valid);
  EXPECT_LT((solution.step - dense.ldlt().solve(-gradient)).norm(), 1e-8);
}

TEST(PoseGraph, LeavesWhatAgreesWhereItIs) {
  auto const poses = ring(40, 5.0);
  auto const result = optimize(poses, steps_of(poses));
  for (std::size_t k = 0; k < poses.size(); ++k) EXPECT_NEAR(distance_m(poses[k], result.poses[k]), 0.0, 1e-9);
}

TEST(PoseGraph, ClosesARingThatDrifted) {
  auto const truth = ring(40, 5.0);
  auto constraints = steps_of(truth);
  std::vector<Pose2> drifted{truth[0]};
  for (auto& step : constraints) {
    step.from_to.yaw += 0.01;
    step.from_to.x *= 1.03;
    drifted.push_back(drifted.back() * step.from_to);
  }
  constraints.push_back(loop(39, 0, between(truth[39], truth[0])));
  ASSERT_GT(distance_m(drifted[39], truth[39]), 1.0);
  auto const result = optimize(drifted, constraints);
  EXPECT_LT(distance_m(result.poses[39], truth[39]), 0.1);
  EXPECT_LT(result.squared_error, squared_error(constraints, drifted));
}

TEST(PoseGraph, AFalseLoopMovesNothingWhenLoopsAreTolerated) {
  auto const truth = ring(40, 5.0);
  auto constraints = steps_of(truth);
  constraints.push_back(loop(39, 0, between(truth[39], truth[0])));
  constraints.push_back(loop(0, 20, {0.5, 0.0, 0.0}));  // ten metres from where it is
  auto const fooled = optimize(truth, constraints);
  auto const robust = optimize(truth, constraints, {.loop_tolerance = 5.0});
  EXPECT_GT(distance_m(fooled.poses[20], truth[20]), 1.0);
  EXPECT_LT(distance_m(robust.poses[20], truth[20]), 0.05);
}

TEST(PoseGraph, OfNothingIsNothing) {
  EXPECT_TRUE(optimize({}, {}).poses.empty());
  EXPECT_EQ(optimize({Pose2{1.0, 2.0, 0.3}}, {}).poses.size(), 1U);
}

}  // namespace
}  // namespace lapwing::slam
