#include "robot/planner/room.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

constexpr double half_turn = std::numbers::pi;

/// One beam, and one that sees nothing behind.
Room seen(double bearing, double range_m) {
  slam::Sensor sensor;
  sensor.bearings_rad = {static_cast<float>(bearing), 3.1F};
  sensor.no_return_m = 10.0F;
  slam::Scan scan;
  scan.ranges_m = {static_cast<float>(range_m), 10.0F};
  return {scan, sensor};
}

TEST(Room, IsTheWayUntilADiscTouches) {
  EXPECT_NEAR(seen(0.0, 1.0).towards(0.0, 0.2), 0.8, 1e-6);
  EXPECT_EQ(seen(half_turn / 2.0, 0.3).towards(0.0, 0.2), 2.0) << "it passes that";
  EXPECT_NEAR(seen(half_turn / 2.0, 0.3).towards(half_turn / 2.0, 0.2), 0.1, 1e-6);
  EXPECT_NEAR(seen(half_turn, 0.5).towards(half_turn, 0.2), 0.3, 1e-6);
  EXPECT_EQ(seen(half_turn, 0.5).towards(0.0, 0.2), 2.0);
  EXPECT_LT(seen(0.0, 0.15).towards(0.0, 0.2), 0.0) << "it is nearer already";
}

TEST(Room, IsNoneWhereNobodyLooks) {
  EXPECT_EQ(Room().towards(0.0, 0.2), 0.0);
  slam::Sensor sensor;
  sensor.bearings_rad = {-1.0F, 1.0F};
  sensor.no_return_m = 10.0F;
  slam::Scan scan;
  scan.ranges_m = {10.0F, 10.0F};
  Room const room(scan, sensor);
  EXPECT_EQ(room.towards(0.5, 0.2), 2.0);
  EXPECT_EQ(room.towards(half_turn, 0.2), 0.0);
  EXPECT_EQ(room.seen_from({0.0, 0.0, half_turn}).towards(half_turn, 0.2), 2.0) << "it looked there before it turned";
}

TEST(Room, GoesWithTheRobot) {
  auto const room = seen(0.0, 1.0).seen_from({0.3, 0.0, half_turn / 2.0});
  EXPECT_NEAR(room.towards(-half_turn / 2.0, 0.2), 0.5, 1e-6);
  EXPECT_EQ(room.towards(0.0, 0.2), 2.0);
}

TEST(Room, OfFewSonarsIsWhatTheyHeardLately) {
  slam::Sensor const sonar{.bearings_rad = {0.0F}, .no_return_m = 5.0F, .half_cone_rad = 0.13F};
  auto const heard = [](double time_s, slam::Pose2 const& odometry, float range_m) {
    return slam::Scan{.time = slam::LogTime(time_s), .odometry = odometry, .ranges_m = {range_m}};
  };
  Room room(heard(0.0, {}, 1.0F), sonar);
  // It turns to the left by a quarter, where nothing is.
  room.take(heard(1.0, {0.0, 0.0, half_turn / 2.0}, 5.0F), sonar);
  EXPECT_EQ(room.towards(0.0, 0.2), 2.0);
  slam::Scan const back = heard(1.5, {0.1, 0.0, 0.0}, 5.0F);
  room.take(back, sonar);
  EXPECT_NEAR(room.towards(0.0, 0.2), 0.7, 1e-6) << "it is silent now, and stands there still";
  room.take(heard(2.5, {0.1, 0.0, 0.0}, 5.0F), sonar);
  EXPECT_EQ(room.towards(0.0, 0.2), 2.0) << "who walked is elsewhere by now";
}

TEST(Room, TakesAWallThatASonarPassesByToGoOn) {
  slam::Sensor const sonars{.bearings_rad = {0.0F, 1.5708F}, .no_return_m = 5.0F, .half_cone_rad = 0.13F};
  // It comes nearer to a wall on its left, by 0.3 m on a metre; ahead nothing is heard.
  auto const passed_by = [&](float step_m) {
    Room room;
    for (int i = 0; i < 5; ++i)
      room.take({.time = slam::LogTime(0.1 * i),
                 .odometry = {0.1 * i, 0.0, 0.0},
                 .ranges_m = {5.0F, 0.5F - step_m * static_cast<float>(i)}},
                sonars);
    return room.towards(0.0, 0.25);
  };
  EXPECT_LT(passed_by(0.03F), 0.5) << "it would touch it there";
  EXPECT_EQ(passed_by(0.0F), 2.0) << "along the wall it goes on";
}

TEST(Room, OfALaserIsWhatTheLastScanShows) {
  slam::Sensor laser{.bearings_rad = {}, .no_return_m = 5.0F};
  for (int i = 0; i < 360; ++i) laser.bearings_rad.push_back(static_cast<float>(-half_turn + i * half_turn / 180.0));
  slam::Scan scan;
  scan.ranges_m.assign(360, 1.0F);
  Room room(scan, laser);
  EXPECT_NEAR(room.towards(0.0, 0.2), 0.8, 0.01);
  scan.ranges_m.assign(360, 5.0F);
  room.take(scan, laser);
  EXPECT_EQ(room.towards(0.0, 0.2), 2.0);
}

}  // namespace
}  // namespace lapwing::robot
