#include "robot/planner/held_up/recovery.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geo/position.hpp"

namespace lapwing::robot {
namespace {

/// In the middle of a square of that half side, open towards its left.
Room in_a_box(double half_side_m, bool has_back = true) {
  slam::Sensor sensor;
  sensor.no_return_m = 10.0F;
  slam::Scan scan;
  for (int i = 0; i < 360; ++i) {
    double const bearing = geo::wrap_pi(i * std::numbers::pi / 180.0);
    sensor.bearings_rad.push_back(static_cast<float>(bearing));
    double const to_wall_m = half_side_m / std::max(std::abs(std::cos(bearing)), std::abs(std::sin(bearing)));
    bool const is_left = std::abs(bearing - std::numbers::pi / 2.0) < 0.75;
    bool const is_back = std::abs(bearing) > 2.4;
    scan.ranges_m.push_back(static_cast<float>(is_left || (is_back && !has_back) ? 9.0 : to_wall_m));
  }
  return {scan, sensor};
}

constexpr double radius_m = 0.18;
std::array constexpr driven{slam::Pose2{-2.0, 0.0, 0.0}, slam::Pose2{-1.0, 0.0, 0.0}, slam::Pose2{-0.5, 0.0, 0.0},
                            slam::Pose2{0.0, 0.0, 0.0}};

TEST(Recovery, GoesBackALittleFirst) {
  auto const room = in_a_box(0.3, false);
  Recovery recovery;
  recovery.begin({.time_s = 1.0, .pose = {0.0, 0.0, 0.2}, .room = room, .driven = driven, .radius_m = radius_m});
  auto const way = recovery.way({.time_s = 1.1, .pose = {0.0, 0.0, 0.2}, .room = room, .driven = driven});
  ASSERT_TRUE(way);
  EXPECT_LT(way->speed_m_s, 0.0);
  EXPECT_EQ(way->yaw_rad, 0.2);
  EXPECT_FALSE(recovery.way({.time_s = 2.0, .pose = {-0.16, 0.0, 0.2}, .room = room, .driven = driven}))
      << "far enough";
}

TEST(Recovery, GoesWhereThereIsRoomWhenThereIsNoneBehind) {
  auto const room = in_a_box(0.3);
  Recovery recovery;
  recovery.begin({.time_s = 1.0, .room = room, .driven = driven, .radius_m = radius_m});
  auto const way = recovery.way({.time_s = 1.1, .room = room, .driven = driven});
  ASSERT_TRUE(way);
  EXPECT_GT(way->speed_m_s, 0.0);
  EXPECT_NEAR(*way->yaw_rad, std::numbers::pi / 2.0, 0.2);
}

TEST(Recovery, GoesBackAsItCameTheSecondTime) {
  auto const room = in_a_box(3.0);
  Recovery recovery;
  recovery.begin({.time_s = 1.0, .room = room, .driven = driven, .radius_m = radius_m});
  recovery.begin({.time_s = 9.0, .room = room, .driven = driven, .radius_m = radius_m});
  EXPECT_EQ(recovery.tried(), 2);
  auto const way = recovery.way({.time_s = 9.1, .room = room, .driven = driven});
  ASSERT_TRUE(way);
  ASSERT_GE(way->points.size(), 3u);
  EXPECT_NEAR(way->points.back().x(), -1.0, 1e-9);
  EXPECT_EQ(way->clear_to, 0u) << "no corner of it is cut";
  EXPECT_FALSE(recovery.way({.time_s = 30.0, .room = room, .driven = driven})) << "not for ever";
}

TEST(Recovery, BeginsAnewWhenTheRobotGotOn) {
  auto const room = in_a_box(3.0);
  Recovery recovery;
  recovery.begin({.time_s = 1.0, .room = room, .driven = driven, .radius_m = radius_m});
  recovery.rest();
  EXPECT_EQ(recovery.tried(), 0);
  EXPECT_FALSE(recovery.way({.time_s = 1.1, .room = room, .driven = driven}));
}

}  // namespace
}  // namespace lapwing::robot
