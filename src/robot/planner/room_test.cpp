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

}  // namespace
}  // namespace lapwing::robot
