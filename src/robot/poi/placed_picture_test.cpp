#include "robot/poi/placed_picture.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

TEST(PlacedPicture, LooksWhereTheCameraLooks) {
  // A robot that looks north, with a camera on its left side, to the left and upwards.
  CameraMount const mount{.x_m = 0.1, .y_m = 0.2, .up_m = 0.9, .yaw_rad = std::numbers::pi / 2.0, .pitch_rad = 0.3};
  auto const picture = placed_picture(
      mount, {.site = "site", .floor = {}, .position = {5.0, 7.0, 1.0}, .yaw_rad = std::numbers::pi / 2.0});
  EXPECT_NEAR(picture.position.x(), 4.8, 1e-9);
  EXPECT_NEAR(picture.position.y(), 7.1, 1e-9);
  EXPECT_NEAR(picture.up_m, 1.9, 1e-9);
  ASSERT_TRUE(picture.site_from_camera);
  Eigen::Vector3d const ahead = *picture.site_from_camera * Eigen::Vector3d::UnitZ();
  EXPECT_TRUE(ahead.isApprox(Eigen::Vector3d(-std::cos(0.3), 0.0, std::sin(0.3)), 1e-9)) << "west, and up";
  Eigen::Vector3d const right = *picture.site_from_camera * Eigen::Vector3d::UnitX();
  EXPECT_TRUE(right.isApprox(Eigen::Vector3d(0.0, 1.0, 0.0), 1e-9)) << "north";
  Eigen::Vector3d const down = *picture.site_from_camera * Eigen::Vector3d::UnitY();
  EXPECT_LT(down.z(), 0.0);
}

}  // namespace
}  // namespace lapwing::robot
