#include "robot/rover/rover_track.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot::rover {
namespace {

using namespace std::chrono_literals;

constexpr double quarter = std::numbers::pi / 2.0;

/// A rover that looks along `heading_rad`, clockwise from north, and tells twenty times a second.
struct RoverTrackTest : ::testing::Test {
  void tell() {
    track.take(mavlink::Attitude{.since_boot = since_boot, .yaw_rad = heading_rad, .yaw_rate_rad_s = rate_rad_s},
               base::TimePoint(since_boot + 7s));
    is_new = track.take(mavlink::LocalPosition{.since_boot = since_boot,
                                               .position_m = geo::Ned{north_m, east_m, 0.0},
                                               .velocity_m_s = geo::Ned{speed_m_s * std::cos(heading_rad),
                                                                        speed_m_s * std::sin(heading_rad), 0.0}},
                        base::TimePoint(since_boot + 7s));
  }
  /// Goes on for so long, and tells.
  void drive(base::Duration time) {
    for (base::Duration left = time; left > 0ms; left -= 50ms) {
      since_boot += 50ms;
      heading_rad += rate_rad_s * 0.05;
      north_m += speed_m_s * 0.05 * std::cos(heading_rad);
      east_m += speed_m_s * 0.05 * std::sin(heading_rad);
      tell();
    }
  }
  [[nodiscard]] slam::Pose2 pose() const { return track.now()->pose; }

  RoverTrack track;
  base::Duration since_boot = 100s;
  double heading_rad = 0.0;
  double north_m = 3.0;
  double east_m = 2.0;
  double speed_m_s = 0.0;
  double rate_rad_s = 0.0;
  bool is_new = false;
};

TEST_F(RoverTrackTest, LooksNorthAlongXAndWestAlongY) {
  heading_rad = quarter;  // east
  tell();
  EXPECT_DOUBLE_EQ(pose().x, 3.0);
  EXPECT_DOUBLE_EQ(pose().y, -2.0);
  EXPECT_DOUBLE_EQ(pose().yaw, -quarter);
  speed_m_s = 0.5;
  drive(2s);
  EXPECT_NEAR(pose().y, -3.0, 1e-9) << "a metre to the east";
  EXPECT_NEAR(pose().x, 3.0, 1e-9);
  EXPECT_NEAR(track.now()->speed_m_s, 0.5, 1e-9);
  EXPECT_EQ(track.corrections(), 0);
}

TEST_F(RoverTrackTest, TellsBackwardsFromAhead) {
  speed_m_s = -0.2;
  drive(1s);
  EXPECT_NEAR(track.now()->speed_m_s, -0.2, 1e-9);
}

TEST_F(RoverTrackTest, FollowsTurnsOnTheSpotThroughNorth) {
  heading_rad = 2.0 * std::numbers::pi - 0.5;
  rate_rad_s = 1.0;
  tell();
  auto const before = pose();
  drive(1s);
  EXPECT_NEAR(slam::between(before, pose()).yaw, -1.0, 1e-6) << "clockwise";
  EXPECT_EQ(track.corrections(), 0);
}

TEST_F(RoverTrackTest, DoesNotTakeTheEstimatorsCorrectionsForMotion) {
  speed_m_s = 0.3;
  drive(1s);
  auto const before = pose();
  north_m += 5.0;  // satellites are there again
  drive(100ms);
  EXPECT_EQ(track.corrections(), 1);
  EXPECT_NEAR(slam::between(before, pose()).x, 0.03, 1e-6);
  heading_rad += 0.6;  // the compass is trusted again
  drive(100ms);
  EXPECT_EQ(track.corrections(), 2);
  EXPECT_NEAR(slam::between(before, pose()).x, 0.06, 1e-3);
  EXPECT_NEAR(slam::between(before, pose()).yaw, 0.0, 1e-6);
  drive(1s);
  EXPECT_NEAR(slam::between(before, pose()).x, 0.36, 1e-3) << "on along the way that it goes";
  EXPECT_EQ(track.corrections(), 2);
}

TEST_F(RoverTrackTest, GoesOnWhereItWasWhenTheAutopilotStartsAnew) {
  speed_m_s = 0.3;
  drive(1s);
  auto const before = pose();
  since_boot = 5s;
  north_m = east_m = heading_rad = speed_m_s = 0.0;
  tell();
  EXPECT_NEAR(slam::distance_m(before, pose()), 0.0, 1e-9);
  speed_m_s = 0.3;
  drive(1s);
  EXPECT_NEAR(slam::distance_m(before, pose()), 0.3, 1e-6);
}

TEST_F(RoverTrackTest, FindsWhereItWasBetweenTwoMoments) {
  speed_m_s = 1.0;
  drive(200ms);
  auto const at = track.now()->at;
  EXPECT_EQ(at, base::TimePoint(since_boot + 7s));
  EXPECT_FALSE(track.at(at + 1ms)) << "nobody knows yet";
  EXPECT_NEAR(track.at(at - 25ms)->x, pose().x - 0.025, 1e-9);
  EXPECT_NEAR(track.at(at - 125ms)->x, pose().x - 0.125, 1e-9) << "some moments ago";
  EXPECT_NEAR(track.at(at - 10s)->x, pose().x, 1e-9) << "too long ago";
}

TEST_F(RoverTrackTest, IsNowhereWithoutAHeading) {
  EXPECT_FALSE(
      track.take(mavlink::LocalPosition{.position_m = geo::Ned{}, .velocity_m_s = geo::Ned{}}, base::TimePoint(7s)));
  tell();
  EXPECT_TRUE(is_new);
  EXPECT_FALSE(track.take(
      mavlink::LocalPosition{.since_boot = since_boot + 1s, .position_m = geo::Ned{}, .velocity_m_s = geo::Ned{}},
      base::TimePoint(since_boot + 8s)))
      << "the heading is old";
  EXPECT_FALSE(track.take(mavlink::LocalPosition{.since_boot = since_boot}, base::TimePoint(since_boot + 8s)))
      << "no place";
}

}  // namespace
}  // namespace lapwing::robot::rover
