#include "slam/graph/marginalize.hpp"

#include <algorithm>

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "slam/graph/pose_graph.hpp"

namespace lapwing::slam {
namespace {

constexpr int many = 100;
std::vector<bool> const stay(5, false);  ///< all but the one that is taken out

Eigen::Matrix3d information(double shift, double turn) {
  return Eigen::Vector3d(shift, shift, turn).asDiagonal();
}

Constraint step(int from, int to, Pose2 const& from_to, bool is_loop = false) {
  return {.from = from, .to = to, .from_to = from_to, .information = information(100.0, 400.0), .is_loop = is_loop};
}

TEST(Marginalized, AddsUpTheErrorsOfTwoSteps) {
  std::vector<Pose2> const poses{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  auto const left = marginalized({step(0, 1, {1, 0, 0}), step(1, 2, {1, 0, 0})}, poses, 1, stay, many);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_LT(distance_m(left[0].from_to, {2, 0, 0}), 1e-6);
  EXPECT_FALSE(left[0].is_loop);
  Eigen::Matrix3d const covariance = left[0].information.inverse();
  EXPECT_NEAR(covariance(0, 0), 0.01 + 0.01, 1e-6);
  // Across, the first step's turn of a twentieth moves the end of the second, a metre on.
  EXPECT_NEAR(covariance(1, 1), 0.01 + 0.01 + 1.0 / 400.0, 1e-6);
  EXPECT_NEAR(covariance(2, 2), 2.0 / 400.0, 1e-6);
}

/// A square with a diagonal, its steps measured a little wrongly, and a loop from the last corner to the first.
std::vector<Constraint> square() {
  return {step(0, 1, {1.02, 0, 1.55}), step(1, 2, {0.99, 0.01, 1.57}), step(2, 3, {1.0, 0, 1.58}),
          step(3, 0, {1.01, 0.02, 1.56}, true)};
}

TEST(Marginalized, MovesNoneOfTheOthersWhereTwoMeet) {
  std::vector<Pose2> const begin{{0, 0, 0}, {1, 0, 1.57}, {1, 1, 3.14}, {0, 1, -1.57}};
  auto const all = optimize(begin, square());
  auto left = marginalized(square(), all.poses, 2, stay, many);
  for (auto& constraint : left)
    for (auto* end : {&constraint.from, &constraint.to}) *end = *end == 3 ? 2 : *end;
  auto const fewer = optimize({begin[0], begin[1], begin[3]}, left);
  EXPECT_LT(distance_m(fewer.poses[1], all.poses[1]), 2e-3);
  EXPECT_LT(distance_m(fewer.poses[2], all.poses[3]), 2e-3);
  EXPECT_NEAR(fewer.squared_error, all.squared_error, 0.02 * all.squared_error);
}

TEST(Marginalized, JoinsWhatStaysInsteadOfHandingALoopOnAlongSteps) {
  // A step back and one ahead, both to key frames that go next, and two loops that know less than the steps do.
  std::vector<Pose2> const poses{{0, 0, 0}, {0.2, 0, 0}, {0.4, 0, 0}, {0.2, 0.1, 0}, {0.2, -0.1, 0}};
  std::vector<Constraint> graph{step(0, 1, {0.2, 0, 0}), step(1, 2, {0.2, 0, 0}), step(1, 3, {0, 0.1, 0}, true),
                                step(1, 4, {0, -0.1, 0}, true)};
  for (auto& constraint : graph)
    if (constraint.is_loop) constraint.information = information(25.0, 100.0);
  auto const has = [](std::vector<Constraint> const& all, int a, int b) {
    return std::ranges::any_of(all,
                               [&](Constraint const& c) { return std::minmax(c.from, c.to) == std::minmax(a, b); });
  };
  auto const left = marginalized(graph, poses, 1, {true, true, true, false, false}, many);
  ASSERT_EQ(left.size(), 3U);
  EXPECT_TRUE(has(left, 0, 2));
  EXPECT_TRUE(has(left, 3, 4));
  EXPECT_FALSE(has(marginalized(graph, poses, 1, stay, many), 3, 4)) << "or this test shows nothing";
}

TEST(Marginalized, KeepsTheTreeThatKnowsMost) {
  // A star of three, one of them measured badly: the two good ones are joined, and the bad one with either.
  std::vector<Pose2> const poses{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  auto star = std::vector{step(0, 1, {1, 0, 0}, true), step(0, 2, {0, 1, 0}, true), step(0, 3, {-1, 0, 0}, true)};
  star[2].information = information(1.0, 4.0);
  auto const left = marginalized(star, poses, 0, stay, many);
  ASSERT_EQ(left.size(), 2U);
  EXPECT_TRUE(std::ranges::any_of(left, [](Constraint const& c) { return c.from == 1 && c.to == 2; }));
}

TEST(Marginalized, LeavesAPathOfStepsBetweenWhatStepsJoined) {
  std::vector<Pose2> const poses{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0.1, 0}};
  auto graph = std::vector{step(0, 1, {1, 0, 0}), step(1, 2, {1, 0, 0}), step(1, 3, {0, 0.1, 0}, true)};
  graph[2].information = information(1e4, 1e4);
  auto const left = marginalized(graph, poses, 1, stay, many);
  auto const steps = std::ranges::count_if(left, [](Constraint const& c) { return !c.is_loop; });
  EXPECT_EQ(steps, 1);
  EXPECT_EQ(left.size(), 2U);
}

TEST(Marginalized, TakesTwoThatJoinTheSameForOne) {
  std::vector<Pose2> const poses{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  auto const left =
      marginalized({step(0, 1, {1, 0, 0}), step(1, 2, {1, 0, 0}), step(2, 0, {-2.04, 0, 0})}, poses, 1, stay, many);
  ASSERT_EQ(left.size(), 1U);
  // Half as sure as the direct one, the way over the middle counts a third.
  EXPECT_NEAR(left[0].from_to.x, -(2.04 * 2.0 + 2.0) / 3.0, 1e-3);
}

TEST(Marginalized, PassesOnNoLoopThatIsOpen) {
  std::vector<Pose2> const poses{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 0}};
  auto const graph = std::vector{step(0, 1, {1, 0, 0}), step(1, 2, {1, 0, 0}), step(1, 3, {0, 0.1, 0}, true)};
  auto const left = marginalized(graph, poses, 1, stay, many);
  EXPECT_TRUE(std::ranges::none_of(left, [](Constraint const& c) { return c.to == 3 || c.from == 3; }));
}

TEST(Marginalized, LeavesNoMoreLoopsThanAsked) {
  std::vector<Pose2> poses{{0, 0, 0}, {1, 0, 0}};
  std::vector<Constraint> graph{step(0, 1, {1, 0, 0})};
  for (int k = 2; k < 12; ++k) {
    poses.push_back({1.0, 0.01 * k, 0.0});
    graph.push_back(step(1, k, {0.0, 0.01 * k, 0.0}, true));
    graph.push_back(step(0, k, {1.0, 0.01 * k, 0.0}, true));
  }
  auto const left = marginalized(graph, poses, 1, stay, 4);
  EXPECT_LE(std::ranges::count_if(left, [](Constraint const& c) { return c.is_loop && (c.from == 0 || c.to == 0); }),
            4);
}

}  // namespace
}  // namespace lapwing::slam
