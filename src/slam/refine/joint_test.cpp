#include "slam/refine/joint.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// A corridor of 24 m that is passed eight times.
slam::testing::Drive drive_to_and_fro() {
  std::vector<Eigen::Vector2d> way;
  for (int i = 0; i < 4; ++i) way.insert(way.end(), {{0.5, 0.0}, {23.5, 0.0}});
  slam::testing::DriveOptions options;
  options.most_range_m = 8.0;
  options.scans_per_s = 2.5;
  return slam::testing::drive(slam::testing::comb(5, 6.0, 3.0), way, options);
}

/// Its scans where they were taken, but for the corridor, which bends to the left: as steps that are a little wrong
/// each make it, and every later passage that is laid upon the first.
Graph bent(slam::testing::Drive const& drive) {
  constexpr double bend_per_m = 3e-4;
  Graph graph;
  for (std::size_t i = 0; i < drive.log.scans.size(); ++i) {
    auto pose = drive.truth[i];
    pose.y += bend_per_m * pose.x * pose.x;
    pose.yaw = geo::wrap_pi(pose.yaw + 2.0 * bend_per_m * pose.x);
    graph.frames.push_back(
        {.scan = static_cast<int>(i), .frame = frame_of(drive.log.scans[i], drive.log.sensors.front(), {})});
    graph.poses.push_back(pose);
  }
  return graph;
}

double most_aside_m(Graph const& graph, slam::testing::Drive const& drive) {
  double most_m = 0.0;
  for (int k = 0; k < graph.size(); ++k) most_m = std::max(most_m, std::abs(graph.poses[k].y - drive.truth[k].y));
  return most_m;
}

TEST(JointAlignment, StraightensACorridor) {
  auto const drive = drive_to_and_fro();
  for (auto const& options : {JointOptions{}, JointOptions{.radius_m = 8.0, .apart_m = 1.5}}) {
    auto graph = bent(drive);
    auto const before_m = most_aside_m(graph, drive);
    refine_jointly(graph, options, one_by_one);
    EXPECT_LT(most_aside_m(graph, drive), 0.4 * before_m);
  }
}

TEST(JointAlignment, HoldsHeadingsThatAreKnown) {
  // Scans that see nothing, of a robot that drove straight on and told a bend.
  Graph graph;
  std::vector<HeldHeading> headings;
  for (int k = 0; k < 20; ++k) {
    graph.frames.emplace_back();
    graph.poses.push_back({0.5 * k, 0.0, 0.02 * k});
    if (k % 5 == 4) headings.push_back({k, {0.0, 0.02}});
  }
  StepSpread const loose{.turn_rad = 0.05};
  JointAlignment alignment(graph, {.steps = loose}, headings);
  while (!alignment.is_done()) alignment.go_on(1, one_by_one);
  auto const& poses = alignment.graph().poses;
  for (auto const& held : headings) EXPECT_NEAR(poses[static_cast<std::size_t>(held.frame)].yaw, 0.0, 0.05);
  refine_jointly(graph, {.steps = loose}, one_by_one);
  EXPECT_NEAR(graph.poses.back().yaw, 0.02 * 19, 1e-6) << "without, the bend stays";
}

TEST(JointAlignment, HoldsStepsByTheirLength) {
  Graph graph;
  graph.frames.resize(3);
  graph.poses = {{}, {0.0, 0.0, 1.0}, {2.0, 0.0, 1.0}};
  // What the last one is to head elsewhere for is taken from the step that turned most.
  StepSpread const by_turn{.turn_rad = 0.001, .turn_per_rad = 0.1};
  JointAlignment alignment(graph, {.steps = by_turn}, {{2, {1.1, 1e-4}}});
  while (!alignment.is_done()) alignment.go_on(1, one_by_one);
  EXPECT_NEAR(alignment.graph().poses[1].yaw, 1.1, 0.01);
  EXPECT_NEAR(alignment.graph().poses[2].yaw, 1.1, 0.01);
}

TEST(JointAlignment, IsTheSameHoweverItsWorkIsCut) {
  auto const drive = drive_to_and_fro();
  auto whole = bent(drive);
  JointAlignment pieces(whole, {});
  refine_jointly(whole, {}, one_by_one);
  int taken = 0;
  for (; !pieces.is_done(); ++taken) pieces.go_on(100, one_by_one);
  EXPECT_GT(taken, 50);
  EXPECT_EQ(pieces.graph().poses, whole.poses);
}

TEST(JointAlignment, OfOneKeyFrameOrNoneIsDone) {
  auto const drive = drive_to_and_fro();
  EXPECT_TRUE(JointAlignment({}, {}).is_done());
  auto graph = bent(drive);
  graph.frames.resize(1);
  graph.poses.resize(1);
  auto const pose = graph.poses.front();
  refine_jointly(graph, {}, one_by_one);
  EXPECT_EQ(graph.poses, std::vector{pose});
}

}  // namespace
}  // namespace lapwing::slam
