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
