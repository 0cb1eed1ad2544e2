#include "slam/loops/consistency.hpp"

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

/// A robot that drives 40 m along a corridor and back beside itself, a key frame a metre; odometry has drifted sideways
/// on the way back.
Graph there_and_back(double drift_m) {
  Graph graph;
  auto const add = [&](Pose2 const& pose) {
    auto const k = graph.size();
    graph.frames.push_back({.scan = k, .frame = {}, .path_m = static_cast<double>(k)});
    graph.poses.push_back(pose);
    if (k > 0)
      graph.constraints.push_back({.from = k - 1,
                                   .to = k,
                                   .from_to = between(graph.poses[k - 1], graph.poses[k]),
                                   .information = 1e6 * Eigen::Matrix3d::Identity()});
  };
  for (int k = 0; k <= 40; ++k) add({static_cast<double>(k), 0.0, 0.0});
  for (int k = 40; k >= 0; --k) add({static_cast<double>(k), drift_m, 3.14159265358979});
  return graph;
}

/// That the robot on its way back is `off` from where it was at `x`.
Closure closure(Graph const& graph, int x, Pose2 const& off) {
  auto const query = 81 - x;
  Pose2 const truth{static_cast<double>(x), 0.0, 3.14159265358979};
  return {.target = x,
          .query = query,
          .target_to_query = between(graph.poses[x], truth * off),
          .information = Eigen::Matrix3d::Identity(),
          .agreement = {}};
}

TEST(Consistency, FindsTheClosuresThatSayTheSameAmongFalseOnes) {
  auto const graph = there_and_back(3.0);
  std::vector<Closure> closures;
  for (auto const x : {10, 12, 14, 16}) closures.push_back(closure(graph, x, {0.02 * (x - 13), 0.0, 0.002}));
  closures.push_back(closure(graph, 11, {4.0, 0.0, 0.0}));   // an office farther on
  closures.push_back(closure(graph, 13, {-4.0, 0.0, 0.0}));  // one farther back
  closures.push_back(closure(graph, 15, {0.0, 0.0, 0.4}));
  auto const groups = consistent_groups(graph, closures, {});
  ASSERT_EQ(groups.size(), 4U);
  auto largest = groups.front();
  std::ranges::sort(largest);
  EXPECT_EQ(largest, (std::vector{0, 1, 2, 3}));
}

TEST(Consistency, CountsWhatOnePlaceSaysOnce) {
  auto const graph = there_and_back(3.0);
  auto const groups = consistent_groups(graph, {closure(graph, 10, {}), closure(graph, 10, {})}, {});
  EXPECT_EQ(groups.size(), 2U);
}

TEST(Consistency, SaysNothingOfClosuresBetweenWhichTheRobotHasDriftedFar) {
  auto const graph = there_and_back(3.0);
  DriftRates const drifting{.shift_per_sqrt_m = 0.5, .turn_per_sqrt_m = 0.05};
  auto const groups = consistent_groups(graph, {closure(graph, 5, {}), closure(graph, 35, {})}, drifting);
  EXPECT_EQ(groups.size(), 2U);
}

TEST(Consistency, OfNothingIsNothing) {
  EXPECT_TRUE(consistent_groups({}, {}, {}).empty());
}

}  // namespace
}  // namespace lapwing::slam
