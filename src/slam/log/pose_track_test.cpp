#include "slam/log/pose_track.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

using namespace std::chrono_literals;

TEST(PoseTrack, GoesOnEvenlyBetweenTwoMoments) {
  // Given in the wrong order: a quarter of a circle of radius one to the left.
  PoseTrack const track({{2s, {1.0, 1.0, std::numbers::pi / 2.0}}, {1s, {}}});
  EXPECT_EQ(track.at(1s), Pose2{});
  auto const half_way = track.at(1500ms);
  ASSERT_TRUE(half_way);
  EXPECT_NEAR(half_way->x, 0.5, 1e-12);
  EXPECT_NEAR(half_way->yaw, std::numbers::pi / 4.0, 1e-12);
}

TEST(PoseTrack, TurnsTheShortWay) {
  PoseTrack const track({{0s, {0.0, 0.0, 3.0}}, {1s, {0.0, 0.0, -3.0}}});
  EXPECT_NEAR(std::abs(track.at(500ms)->yaw), std::numbers::pi, 1e-9);
}

TEST(PoseTrack, KnowsNothingFarBeyondItsEnds) {
  PoseTrack const track({{1s, {1.0, 0.0, 0.0}}, {2s, {2.0, 0.0, 0.0}}});
  EXPECT_EQ(track.at(950ms), (Pose2{1.0, 0.0, 0.0}));
  EXPECT_EQ(track.at(2100ms), (Pose2{2.0, 0.0, 0.0}));
  EXPECT_FALSE(track.at(899ms));
  EXPECT_FALSE(track.at(2101ms));
  EXPECT_FALSE(PoseTrack().at(0s));
}

TEST(PoseTrack, LeavesOutWhatIsNoPlaceAndWhatComesTwice) {
  PoseTrack const track({{1s, {1.0, 0.0, 0.0}}, {1s, {9.0, 0.0, 0.0}}, {2s, {std::nan(""), 0.0, 0.0}}});
  EXPECT_EQ(track.at(1s), (Pose2{1.0, 0.0, 0.0}));
  EXPECT_FALSE(track.at(2s));
}

TEST(PoseTrack, GrowsWhileTheRobotDrivesAndBeginsAnewWithItsClock) {
  PoseTrack track;
  for (int i = 0; i < 10; ++i) track.add({.stamp = 100ms * i, .pose = {0.1 * i, 0.0, 0.0}});
  EXPECT_NEAR(track.at(450ms)->x, 0.45, 1e-9);
  track.forget_before(600ms);
  EXPECT_FALSE(track.at(450ms));
  EXPECT_NEAR(track.at(650ms)->x, 0.65, 1e-9);
  track.add({.stamp = 100ms, .pose = {5.0, 0.0, 0.0}});
  EXPECT_FALSE(track.at(650ms));
  EXPECT_DOUBLE_EQ(track.at(100ms)->x, 5.0);
}

}  // namespace
}  // namespace lapwing::slam
