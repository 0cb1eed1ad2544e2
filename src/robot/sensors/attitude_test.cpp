#include "robot/sensors/attitude.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using std::numbers::pi;

firmware::Quaternion product(firmware::Quaternion const& a, firmware::Quaternion const& b) {
  return {.w = a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
          .x = a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          .y = a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          .z = a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Turned about z, then about the new y, then about the newest x.
firmware::Quaternion turned(double yaw, double pitch, double roll) {
  auto const half = [](double angle, auto of) { return static_cast<float>(of(angle / 2)); };
  auto const cosine = [](double angle) { return std::cos(angle); };
  auto const sine = [](double angle) { return std::sin(angle); };
  firmware::Quaternion const about_z{.w = half(yaw, cosine), .x = 0, .y = 0, .z = half(yaw, sine)};
  firmware::Quaternion const about_y{.w = half(pitch, cosine), .x = 0, .y = half(pitch, sine), .z = 0};
  firmware::Quaternion const about_x{.w = half(roll, cosine), .x = half(roll, sine), .y = 0, .z = 0};
  return product(product(about_z, about_y), about_x);
}

TEST(Attitude, GivesBackTheAnglesOfEveryTurn) {
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 11; ++j)
      for (int k = 0; k < 9; ++k) {
        double const yaw = -3.1 + 0.4 * i;
        double const pitch = -1.5 + 0.3 * j;
        double const roll = -3.1 + 0.7 * k;
        auto const said = attitude(turned(yaw, pitch, roll));
        EXPECT_NEAR(said.yaw_rad, yaw, 1e-5);
        EXPECT_NEAR(said.pitch_rad, pitch, 1e-5);
        EXPECT_NEAR(said.roll_rad, roll, 1e-5);
      }
}

TEST(Attitude, DoesNotDependOnTheLengthOrTheSign) {
  auto turn = turned(1.0, 0.2, -0.3);
  for (float* const part : {&turn.w, &turn.x, &turn.y, &turn.z}) *part *= -0.97F;
  EXPECT_NEAR(attitude(turn).yaw_rad, 1.0, 1e-5);
  EXPECT_NEAR(attitude(turn).roll_rad, -0.3, 1e-5);
}

TEST(Attitude, StraightUpAndDownIsAllYaw) {
  for (double const pitch : {pi / 2, -pi / 2}) {
    auto const said = attitude(turned(0.8, pitch, 0.0));
    EXPECT_NEAR(said.pitch_rad, pitch, 1e-3);
    EXPECT_NEAR(said.yaw_rad, 0.8, 1e-3);
    EXPECT_EQ(said.roll_rad, 0.0);
  }
}

}  // namespace
}  // namespace lapwing::robot
