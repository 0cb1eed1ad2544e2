#include "robot/ros/scan_sides.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot::ros {
namespace {

constexpr float quarter = std::numbers::pi_v<float> / 2.0F;

TEST(ScanSides, AreTheNearestToTheRightAheadAndLeft) {
  slam::Sensor const laser{.bearings_rad = {-quarter, 0.0F, 0.1F, quarter}, .no_return_m = 12.0F};
  auto const sides = sides_of(laser, {1.0F, 2.5F, 2.0F, 3.0F});
  EXPECT_DOUBLE_EQ(sides.right_m, 1.0);
  EXPECT_DOUBLE_EQ(sides.front_m, 2.0);
  EXPECT_DOUBLE_EQ(sides.left_m, 3.0);
}

TEST(ScanSides, AreAsFarAsASonarHearsWhereNothingIs) {
  slam::Sensor const laser{.bearings_rad = {-quarter, 0.0F, quarter}, .no_return_m = 12.0F};
  auto const sides = sides_of(laser, {0.0F, 12.0F, 9.0F});
  EXPECT_DOUBLE_EQ(sides.right_m, 5.0);
  EXPECT_DOUBLE_EQ(sides.front_m, 7.5);
  EXPECT_DOUBLE_EQ(sides.left_m, 5.0);
}

}  // namespace
}  // namespace lapwing::robot::ros
