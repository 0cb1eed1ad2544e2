#include "robot/planner/follower.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using slam::Pose2;

constexpr Room plenty{.ahead_m = 5.0, .behind_m = 5.0};

/// Drives it for so many seconds as it steers.
Pose2 follow(Follower& follower, Pose2 pose, double seconds, Room const& room = plenty) {
  constexpr double step_s = 0.1;
  for (double t = 0.0; t < seconds; t += step_s) {
    auto const motion = follower.steer(pose, room);
    pose = pose * Pose2{motion.speed_m_s * step_s, 0.0, motion.turn_rad_s * step_s};
  }
  return pose;
}

std::vector<Place> corner() {
  std::vector<Place> points;
  for (int i = 0; i <= 40; ++i) points.emplace_back(0.05 * i, 0.0);
  for (int i = 1; i <= 40; ++i) points.emplace_back(2.0, 0.05 * i);
  return points;
}

TEST(Follower, ComesToTheEndOfAWayRoundACorner) {
  Follower follower({});
  follower.take({.points = corner(), .is_to_the_end = true, .speed_m_s = 0.3});
  auto const end = follow(follower, {}, 40.0);
  EXPECT_TRUE(follower.has_arrived());
  EXPECT_NEAR(end.x, 2.0, 0.15);
  EXPECT_NEAR(end.y, 2.0, 0.15);
  EXPECT_EQ(follower.steer(end, plenty), Motion{});
}

TEST(Follower, KeepsNearItsWay) {
  Follower follower({});
  auto const points = corner();
  follower.take({.points = points, .is_to_the_end = true, .speed_m_s = 0.3});
  Pose2 pose;
  for (int i = 0; i < 300; ++i) {
    pose = follow(follower, pose, 0.1);
    double nearest = 1e9;
    for (auto const& point : points) nearest = std::min(nearest, std::hypot(point.x() - pose.x, point.y() - pose.y));
    ASSERT_LT(nearest, 0.2) << "at " << pose.x << ", " << pose.y;
  }
}

TEST(Follower, CutsNoCornerThatIsNotFree) {
  auto const whole = corner();
  std::vector<Place> const points(whole.begin() + 30, whole.end());  // the corner is the eleventh
  auto const heading_with = [&](std::size_t clear_to) {
    Follower follower({});
    follower.take({.points = points, .clear_to = clear_to, .is_to_the_end = true, .speed_m_s = 0.3});
    return follower.steer({1.8, 0.0, 0.0}, plenty).turn_rad_s;
  };
  EXPECT_GT(heading_with(points.size()), 0.5) << "towards the way behind the corner";
  EXPECT_NEAR(heading_with(10), 0.0, 0.01) << "to the corner first";
}

TEST(Follower, TurnsOnTheSpotTowardsWhatLiesBehind) {
  Follower follower({});
  follower.take({.points = {{0.0, 0.0}, {-1.0, 0.0}}, .is_to_the_end = true, .speed_m_s = 0.3});
  auto const motion = follower.steer({}, plenty);
  EXPECT_EQ(motion.speed_m_s, 0.0);
  EXPECT_EQ(std::abs(motion.turn_rad_s), Limits{}.turn_rad_s);
}

TEST(Follower, StandsBeforeWhatIsInItsWayAndSlowsDownTowardsIt) {
  Follower follower({});
  follower.take({.points = corner(), .is_to_the_end = true, .speed_m_s = 0.3});
  EXPECT_EQ(follower.steer({}, {0.0}).speed_m_s, 0.0);
  EXPECT_EQ(follower.steer({}, {-0.1}).speed_m_s, 0.0);
  double const slow = follower.steer({}, {0.05}).speed_m_s;
  EXPECT_GT(slow, 0.0);
  // It can brake within the room that there is.
  EXPECT_LE(slow * slow / (2.0 * Limits{}.acceleration_m_s2), 0.05 + 1e-9);
}

TEST(Follower, DrivesByAHeadingWithoutAWay) {
  Follower follower({});
  follower.take({.yaw_rad = 0.3, .speed_m_s = 0.2});
  auto const end = follow(follower, {}, 10.0);
  EXPECT_NEAR(end.yaw, 0.3, 0.02);
  EXPECT_GT(end.x, 1.0);
  EXPECT_FALSE(follower.has_arrived());
}

TEST(Follower, StandsWithoutAWay) {
  Follower follower({});
  EXPECT_EQ(follower.steer({}, plenty), Motion{});
  follower.take({.points = corner(), .speed_m_s = 0.3});
  follower.stop();
  EXPECT_EQ(follower.steer({}, plenty), Motion{});
}

TEST(Follower, GoesBackNoFartherThanThereIsRoom) {
  Follower follower(Limits{});
  follower.take({.yaw_rad = 0.0, .speed_m_s = -0.08});
  EXPECT_EQ(follower.steer({}, {.ahead_m = 0.0, .behind_m = 1.0}).speed_m_s, -0.08);
  EXPECT_EQ(follower.steer({}, {.ahead_m = 5.0, .behind_m = 0.0}).speed_m_s, 0.0);
  EXPECT_EQ(follower.steer({}, {.ahead_m = 5.0, .behind_m = -0.1}).speed_m_s, 0.0);
}

slam::Scan scan_of(slam::Sensor& sensor, double bearing, double range) {
  sensor.bearings_rad = {static_cast<float>(bearing)};
  sensor.no_return_m = 10.0F;
  slam::Scan scan;
  scan.ranges_m = {static_cast<float>(range)};
  return scan;
}

TEST(Room, CountsWhatTheRobotWouldTouch) {
  slam::Sensor sensor;
  Limits const limits{.radius_m = 0.2, .safe_distance_m = 0.05};
  auto const ahead = scan_of(sensor, 0.0, 1.0);
  EXPECT_NEAR(room_of(ahead, sensor, limits).ahead_m, 1.0 - 0.22, 1e-6);
  auto const beside = scan_of(sensor, std::numbers::pi / 2.0, 0.3);
  EXPECT_EQ(room_of(beside, sensor, limits).ahead_m, 2.0) << "it passes that";
  auto const behind = scan_of(sensor, std::numbers::pi, 0.25);
  EXPECT_EQ(room_of(behind, sensor, limits).ahead_m, 2.0);
  EXPECT_NEAR(room_of(behind, sensor, limits).behind_m, 0.25 - 0.22, 1e-6);
  auto const nothing = scan_of(sensor, 0.0, 10.0);
  EXPECT_EQ(room_of(nothing, sensor, limits).behind_m, 0.0) << "nobody looks there";
  EXPECT_EQ(room_of(nothing, sensor, limits).ahead_m, 2.0);
  auto const touching = scan_of(sensor, 0.0, 0.15);
  EXPECT_LT(room_of(touching, sensor, limits).ahead_m, 0.0);
}

}  // namespace
}  // namespace lapwing::robot
