#include "robot/planner/follower.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using slam::Pose2;

/// Of ends in the robot's frame.
Room room_with(std::vector<Eigen::Vector2d> const& ends) {
  slam::Sensor sensor;
  sensor.bearings_rad = {3.1F};
  sensor.no_return_m = 10.0F;
  slam::Scan scan;
  scan.ranges_m = {10.0F};
  for (auto const& end : ends) {
    sensor.bearings_rad.push_back(static_cast<float>(std::atan2(end.y(), end.x())));
    scan.ranges_m.push_back(static_cast<float>(end.norm()));
  }
  return {scan, sensor};
}

Room const plenty = room_with({});

/// A wall across its way, so far before its hull.
Room wall_before(double far_m) {
  std::vector<Eigen::Vector2d> ends;
  for (int i = -40; i <= 40; ++i) ends.emplace_back(Limits{}.radius_m + 0.02 + far_m, 0.05 * i);
  return room_with(ends);
}

/// Drives it for so many seconds as it steers.
Pose2 follow(Follower& follower, Pose2 pose, double seconds, Room const& room = plenty) {
  constexpr double step_s = 0.1;
  for (int i = 0; i * step_s < seconds; ++i) {
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
  EXPECT_NEAR(follower.steer({}, wall_before(0.0)).speed_m_s, 0.0, 1e-3);
  EXPECT_EQ(follower.steer({}, wall_before(-0.1)).speed_m_s, 0.0);
  double const slow = follower.steer({}, wall_before(0.05)).speed_m_s;
  EXPECT_GT(slow, 0.0);
  // It can brake within the room that there is.
  EXPECT_LE(slow * slow / (2.0 * Limits{}.acceleration_m_s2), 0.05 + 1e-6);
}

TEST(Follower, GoesByWhatStandsNearerToItsWayThanItsMapHasIt) {
  Follower follower({});
  std::vector<Place> points;
  for (int i = 0; i <= 40; ++i) points.emplace_back(0.05 * i, 0.0);
  // Door posts whose middle is 6 cm beside the way, and the walls on both sides of them.
  std::vector<Eigen::Vector2d> posts;
  for (int i = 0; i <= 20; ++i) {
    posts.emplace_back(1.0, 0.30 + 0.05 * i);
    posts.emplace_back(1.0, -0.18 - 0.05 * i);
  }
  auto const room_at = [&](Pose2 const& pose) {
    std::vector<Eigen::Vector2d> ends;
    for (auto const& post : posts) {
      auto const end = slam::Turn(pose.yaw).back(post - slam::place(pose));
      ends.push_back(end);
    }
    return room_with(ends);
  };
  follower.take({.points = points, .is_to_the_end = true, .speed_m_s = 0.16});
  Pose2 pose;
  double nearest_m = 1.0;
  for (int i = 0; i < 400; ++i) {
    auto const motion = follower.steer(pose, room_at(pose));
    pose = pose * Pose2{0.1 * motion.speed_m_s, 0.0, 0.1 * motion.turn_rad_s};
    for (auto const& post : posts) nearest_m = std::min(nearest_m, (post - slam::place(pose)).norm());
  }
  EXPECT_TRUE(follower.has_arrived()) << pose.x << ", " << pose.y;
  EXPECT_GT(nearest_m, Limits{}.radius_m + 0.02);
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
  EXPECT_EQ(follower.steer({}, wall_before(0.0)).speed_m_s, -0.08);
  EXPECT_NEAR(follower.steer({}, room_with({{-0.2, 0.0}})).speed_m_s, 0.0, 1e-3);
  EXPECT_EQ(follower.steer({}, room_with({{-0.1, 0.0}})).speed_m_s, 0.0);
}

TEST(Follower, TurnsNoFasterThanItsWayAllows) {
  Follower follower{Limits{}};
  follower.take({.yaw_rad = 3.0, .turn_rad_s = 0.5});
  EXPECT_EQ(follower.steer({}, Room()).turn_rad_s, 0.5);
  follower.take({.yaw_rad = -3.0, .turn_rad_s = 0.5});
  EXPECT_EQ(follower.steer({}, Room()).turn_rad_s, -0.5);
}

}  // namespace
}  // namespace lapwing::robot
