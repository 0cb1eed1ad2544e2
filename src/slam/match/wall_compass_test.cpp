#include "slam/match/wall_compass.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "slam/pose2.hpp"

namespace lapwing::slam {
namespace {

constexpr double degree = 0.017453292519943295;

/// Of a room 6 by 4 m, as it looks from its middle to a robot that heads `yaw_rad` from along its length, a wall's
/// point each 0.1 m, each normal off by some three degrees.
Frame room_from(double yaw_rad, std::uint32_t seed = 1) {
  std::mt19937 dice(seed);
  std::normal_distribution<double> off(0.0, 3.0 * degree);
  Frame frame;
  Turn const turn(-yaw_rad);
  auto const see = [&](Eigen::Vector2d const& at, Eigen::Vector2d const& normal) {
    frame.points.push_back((turn * at).cast<float>());
    frame.normals.push_back((turn * (Turn(off(dice)) * normal)).cast<float>());
  };
  for (double x = -3.0; x < 3.0; x += 0.1)
    for (double const side : {-1.0, 1.0}) see({x, 2.0 * side}, {0.0, -side});
  for (double y = -2.0; y < 2.0; y += 0.1)
    for (double const side : {-1.0, 1.0}) see({3.0 * side, y}, {-side, 0.0});
  return frame;
}

/// Of things that stand about in all directions.
Frame thicket() {
  Frame frame;
  for (int i = 0; i < 90; ++i) {
    auto const angle = 0.1F * static_cast<float>(i);
    frame.points.emplace_back(std::cos(angle), std::sin(angle));
    frame.normals.emplace_back(-std::cos(angle), -std::sin(angle));
  }
  return frame;
}

struct Seen {
  std::vector<KeyFrame> frames;
  std::vector<Pose2> poses;
  void add(double yaw_rad, double told_rad) {
    frames.push_back({.frame = room_from(yaw_rad, static_cast<std::uint32_t>(frames.size()) + 7)});
    poses.push_back({0.0, 0.0, told_rad});
  }
};

TEST(DirectionOfWalls, IsThatOfMostOfThem) {
  for (double const yaw : {0.0, 0.3, -0.7, 2.9}) {
    auto const direction = direction_of_walls(room_from(yaw));
    ASSERT_TRUE(direction) << yaw;
    EXPECT_NEAR(std::sin(4.0 * (direction->rad + yaw)), 0.0, 4.0 * 1.0 * degree) << "but for right angles";
    EXPECT_GT(std::cos(4.0 * (direction->rad + yaw)), 0.9);
    EXPECT_LT(direction->sigma_rad, 2.0 * degree);
  }
}

TEST(DirectionOfWalls, IsNoneWhereThingsStandInAllDirectionsOrFewAreSeen) {
  EXPECT_FALSE(direction_of_walls(thicket()));
  EXPECT_FALSE(direction_of_walls(Frame{}));
  auto few = room_from(0.0);
  few.points.resize(8);
  few.normals.resize(8);
  EXPECT_FALSE(direction_of_walls(few));
}

TEST(WallCompass, TurnsARobotBackThatHasDrifted) {
  Seen seen;
  for (int i = 0; i < 20; ++i) seen.add(0.1 * i, 0.1 * i);
  WallCompass compass;
  for (double const drift : {-4.0 * degree, 0.0, 4.0 * degree}) {
    double const yaw = 2.2;  // through more than a right angle
    auto const told = compass.heading(seen.frames, seen.poses, room_from(yaw), {yaw + drift, 2.0 * degree});
    ASSERT_TRUE(told) << drift;
    EXPECT_NEAR(told->yaw_rad, yaw, 1.0 * degree);
    EXPECT_GT(told->sigma_rad, 0.0);
  }
}

TEST(WallCompass, LeavesAWingAtAnotherAngleItsOwnDirection) {
  Seen seen;
  for (int i = 0; i < 20; ++i) seen.add(0.1 * i, 0.1 * i);
  WallCompass compass;
  Heading const expected{1.0, 2.0 * degree};
  auto const wing = room_from(1.0 - 30.0 * degree);
  EXPECT_FALSE(compass.heading(seen.frames, seen.poses, wing, expected)) << "no drift turns a robot that far";
  // After as long in the wing its walls count as much.
  for (int i = 0; i < 20; ++i) seen.add(0.1 * i - 30.0 * degree, 0.1 * i);
  auto const told = compass.heading(seen.frames, seen.poses, wing, {1.0 + 3.0 * degree, 2.0 * degree});
  ASSERT_TRUE(told);
  EXPECT_NEAR(told->yaw_rad, 1.0, 1.0 * degree);
}

TEST(WallCompass, SaysNothingAtFirstAndOfWhatHasNoWalls) {
  WallCompass compass;
  EXPECT_FALSE(compass.heading({}, {}, room_from(0.0), {0.0, 2.0 * degree}));
  Seen seen;
  for (int i = 0; i < 3; ++i) seen.add(0.0, 0.0);
  EXPECT_FALSE(compass.heading(seen.frames, seen.poses, room_from(0.0), {0.0, 2.0 * degree}));
  for (int i = 0; i < 20; ++i) seen.add(0.0, 0.0);
  EXPECT_TRUE(compass.heading(seen.frames, seen.poses, room_from(0.0), {0.0, 2.0 * degree}));
  EXPECT_FALSE(compass.heading(seen.frames, seen.poses, thicket(), {0.0, 2.0 * degree}));
}

}  // namespace
}  // namespace lapwing::slam
