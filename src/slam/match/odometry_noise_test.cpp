#include "slam/match/odometry_noise.hpp"

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

/// What is expected of a step of a decimetre after a hundred of them, each off by that much, that far from the origin.
OdometryNoise::Spread learned(double off_m, double off_rad, double far_m) {
  OdometryNoise noise;
  Pose2 const step{0.1, 0.0, 0.0};
  for (int i = 0; i < 100; ++i) {
    Pose2 const predicted{far_m + 0.1 * i, 0.0, 0.0};
    noise.learn(step, predicted, predicted * Pose2{off_m, 0.0, off_rad}, true);
  }
  return noise.of(step);
}

TEST(OdometryNoise, LearnsThatOdometryErrsMoreThanUsual) {
  auto const usual = learned(0.0, 0.0, 0.0);
  auto const learnt = learned(0.2, 0.08, 0.0);
  EXPECT_GT(learnt.shift_m, 1.5 * usual.shift_m);
  EXPECT_GT(learnt.turn_rad, 1.5 * usual.turn_rad);
}

TEST(OdometryNoise, LearnsTheSameFarFromWhereItBegan) {
  auto const near = learned(0.2, 0.08, 0.0);
  auto const far = learned(0.2, 0.08, 500.0);
  EXPECT_NEAR(near.shift_m, far.shift_m, 1e-9);
  EXPECT_NEAR(near.turn_rad, far.turn_rad, 1e-9);
}

}  // namespace
}  // namespace lapwing::slam
