#include "slam/graph/chordal.hpp"

#include <gtest/gtest.h>

#include "slam/graph/pose_graph.hpp"

namespace lapwing::slam {
namespace {

/// Along the sides of squares, round and round.
std::vector<Pose2> squares(int count) {
  std::vector<Pose2> poses{{1.0, -2.0, 0.4}};
  for (int k = 1; k < count; ++k) poses.push_back(poses.back() * Pose2{1.0, 0.0, k % 5 == 0 ? 1.5707963 : 0.0});
  return poses;
}

Constraint edge(std::vector<Pose2> const& poses, int from, int to) {
  return {.from = from, .to = to, .from_to = between(poses[from], poses[to]), .is_loop = std::abs(from - to) > 1};
}

TEST(Chordal, IsTheTruthWhereConstraintsDoNotErr) {
  auto const truth = squares(60);
  std::vector<Constraint> constraints;
  for (int k = 1; k < 60; ++k) constraints.push_back(edge(truth, k - 1, k));
  for (int k = 20; k < 60; k += 7) constraints.push_back(edge(truth, k, k - 20));
  auto const poses = chordal_poses(truth.size(), truth.front(), constraints);
  for (std::size_t k = 0; k < truth.size(); ++k) {
    EXPECT_LT(distance_m(poses[k], truth[k]), 1e-4) << k;
    EXPECT_LT(turn_rad(poses[k], truth[k]), 1e-5) << k;
  }
}

TEST(Chordal, BeginsOnTheRightSideOfTheHillWherePosesThatAreGivenDoNot) {
  auto const truth = squares(200);
  std::vector<Constraint> constraints;
  for (int k = 1; k < 200; ++k) constraints.push_back(edge(truth, k - 1, k));
  for (int k = 20; k < 200; k += 3) constraints.push_back(edge(truth, k - 20, k));
  std::vector<Pose2> astray{truth.front()};
  for (int k = 1; k < 200; ++k) astray.push_back(astray.back() * Pose2{1.0, 0.0, 0.9});
  auto const settled = optimize(chordal_poses(truth.size(), truth.front(), constraints), constraints);
  EXPECT_LT(settled.squared_error, 1e-6);
  EXPECT_GT(squared_error(constraints, astray), 100.0);
}

TEST(Chordal, OfNothingIsNothing) {
  EXPECT_TRUE(chordal_poses(0, {}, {}).empty());
}

}  // namespace
}  // namespace lapwing::slam
