#include "robot/sensors/body_filter.hpp"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using Vector = BodyFilter::Vector;

TEST(BodyFilter, LevelsItselfByGravityWithoutTurning) {
  for (double const roll : {-0.2, 0.0, 0.3})
    for (double const pitch : {-0.3, 0.1}) {
      Eigen::Quaterniond const tilt =
          Eigen::AngleAxisd(pitch, Vector::UnitY()) * Eigen::AngleAxisd(roll, Vector::UnitX());
      BodyFilter filter;
      filter.level(tilt.inverse() * Vector(0, 0, 9.80665));
      EXPECT_NEAR(filter.yaw_rad(), 0, 1e-9);
      EXPECT_NEAR(filter.state().orientation.angularDistance(tilt), 0, 1e-9);
    }
}

TEST(BodyFilter, IntegratesWhatIsFeltExactlyOnAStraightLine) {
  BodyFilter filter;
  for (int i = 0; i < 20; ++i) filter.predict(100ms, Vector::Zero(), Vector(0.2, 0, 9.80665));
  EXPECT_NEAR(filter.state().velocity_m_s.x(), 0.4, 1e-9);
  EXPECT_NEAR(filter.state().position_m.x(), 0.4, 1e-9);
}

TEST(BodyFilter, LearnsTheBiasOfTheGyroscopeWhileItStands) {
  BodyFilter filter;
  Vector const bias(0.02, -0.01, 0.03);
  for (int i = 0; i < 20; ++i) {
    filter.predict(100ms, bias, Vector(0, 0, 9.80665));
    EXPECT_TRUE(filter.correct_standing(bias));
  }
  EXPECT_LT((filter.state().rate_bias_rad_s - bias).norm(), 1e-4);
  EXPECT_LT(std::sqrt(filter.covariance()(14, 14)), 5e-4);
}

TEST(BodyFilter, DoesNotTakeATurnForABias) {
  BodyFilter filter;
  for (int i = 0; i < 20; ++i) {
    filter.predict(100ms, Vector::Zero(), Vector(0, 0, 9.80665));
    (void)filter.correct_standing(Vector::Zero());
  }
  // The wheels are locked and somebody turns the body.
  EXPECT_FALSE(filter.correct_standing(Vector(0, 0, 0.1)));
  EXPECT_NEAR(filter.state().rate_bias_rad_s.z(), 0, 1e-4);
}

TEST(BodyFilter, RefusesASpeedThatCannotBe) {
  BodyFilter filter;
  for (int i = 0; i < 20; ++i) {
    filter.predict(100ms, Vector::Zero(), Vector(0, 0, 9.80665));
    (void)filter.correct_standing(Vector::Zero());
  }
  filter.predict(100ms, Vector::Zero(), Vector(0, 0, 9.80665));
  EXPECT_FALSE(filter.correct_speed(0.5));
  EXPECT_NEAR(filter.state().velocity_m_s.x(), 0, 0.01);
  filter.take_speed(0.5);
  EXPECT_NEAR(filter.state().velocity_m_s.x(), 0.5, 0.02);
}

TEST(BodyFilter, ItsUncertaintyIsACovarianceWhateverHappens) {
  BodyFilter filter;
  for (int i = 0; i < 3'000; ++i) {
    double const turn = std::sin(i * 0.05);
    filter.predict(100ms, Vector(0.01, 0, turn), Vector(0.1 * std::cos(i * 0.1), 0.2 * turn, 9.8));
    if (i % 7 == 0)
      filter.predict_by_wheels(100ms, turn);
    else if (!filter.correct_speed(0.2))
      filter.take_speed(0.2);
    if (i % 50 == 0) (void)filter.correct_standing(Vector(0, 0, 0.001));
  }
  BodyFilter::Covariance const& p = filter.covariance();
  EXPECT_TRUE(p.allFinite());
  EXPECT_LT((p - p.transpose()).norm(), 1e-6 * p.norm());
  Eigen::SelfAdjointEigenSolver<BodyFilter::Covariance> const parts(p);
  EXPECT_GT(parts.eigenvalues().minCoeff(), -1e-9);
  EXPECT_NEAR(filter.state().orientation.norm(), 1, 1e-9);
}

}  // namespace
}  // namespace lapwing::robot
