#include "slam/loops/spread.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

constexpr int steps = 20;

/// Straight on, half a metre a step, of which the fifth has its turn as sure as that; all others as sure as scans make
/// it.
std::vector<Constraint> steps_with_one_of(double turn_rad) {
  std::vector<Constraint> constraints;
  for (int k = 0; k < steps; ++k) {
    auto const sure_rad = k == 5 ? turn_rad : 0.001;
    constraints.push_back({.from = k,
                           .to = k + 1,
                           .from_to = {0.5, 0.0, 0.0},
                           .information = Eigen::Vector3d(1e4, 1e4, 1.0 / (sure_rad * sure_rad)).asDiagonal()});
  }
  return constraints;
}

Drift drift_of_the_last(std::vector<Constraint> const& constraints, DriftRates const& rates) {
  std::vector<Pose2> poses;
  for (int k = 0; k <= steps; ++k) poses.push_back({0.5 * k, 0.0, 0.0});
  return drift_from(0, poses, constraints, rates).back();
}

TEST(Spread, AddsUpAsTheRatesSayWhereScansSawEachStep) {
  DriftRates const rates;
  auto const drift = drift_of_the_last(steps_with_one_of(0.001), rates);
  EXPECT_NEAR(drift.turn_rad, rates.turn_per_sqrt_m * std::sqrt(0.5 * steps), 1e-9);
  EXPECT_NEAR(drift.path_m, 0.5 * steps, 1e-9);
}

TEST(Spread, CovarianceIsThatOfManyDrivesWhoseStepsErr) {
  // Round a corner: 10 m ahead, then 5 m to the left.
  std::vector<Pose2> poses{{}};
  std::vector<Constraint> constraints;
  for (int k = 0; k < 30; ++k) {
    Pose2 const step{0.5, 0.0, k == 20 ? 0.5 * std::numbers::pi : 0.0};
    constraints.push_back({.from = k, .to = k + 1, .from_to = step, .information = 1e6 * Eigen::Matrix3d::Identity()});
    poses.push_back(poses.back() * step);
  }
  DriftRates const rates;
  auto const drift = drift_from(0, poses, constraints, rates).back();
  std::mt19937 dice(1);
  std::normal_distribution<double> normal;
  constexpr int drives = 20'000;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < drives; ++i) {
    Pose2 at;
    for (auto const& constraint : constraints) {
      auto const& step = constraint.from_to;
      double const shift_m = rates.shift_per_sqrt_m * std::sqrt(step.x);
      double const turn2 =
          rates.turn_per_sqrt_m * rates.turn_per_sqrt_m * step.x + rates.turn_per_rad * rates.turn_per_rad * step.yaw;
      at = at * Pose2{0.0, 0.0, std::sqrt(turn2) * normal(dice)} *
           Pose2{step.x + shift_m * normal(dice), shift_m * normal(dice), step.yaw};
    }
    Eigen::Vector3d const off(at.x - poses.back().x, at.y - poses.back().y, geo::wrap_pi(at.yaw - poses.back().yaw));
    sum += off * off.transpose();
  }
  Eigen::Matrix3d const seen = sum / drives;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      double const scale = std::sqrt(seen(row, row) * seen(column, column));
      EXPECT_NEAR(drift.covariance(row, column), seen(row, column), 0.05 * scale) << row << ' ' << column;
    }
  }
}

TEST(Spread, GrowsByATurnThatNoScanSaw) {
  DriftRates rates;
  rates.unseen_share = 0.3;
  constexpr double unseen_rad = 0.4;
  auto const seen = drift_of_the_last(steps_with_one_of(0.001), rates);
  auto const drift = drift_of_the_last(steps_with_one_of(unseen_rad), rates);
  auto const added = rates.unseen_share * unseen_rad;
  EXPECT_NEAR(drift.turn_rad, std::hypot(seen.turn_rad, added), 1e-3);
  // The end is some 7 m from where the turn was.
  EXPECT_GT(drift.shift_m, 7.0 * added);
}

TEST(Spread, LeavesOutWhatNoScanSawWhereItsShareIsNothing) {
  DriftRates rates;
  rates.unseen_share = 0.0;
  EXPECT_DOUBLE_EQ(drift_of_the_last(steps_with_one_of(0.4), rates).turn_rad,
                   drift_of_the_last(steps_with_one_of(0.001), rates).turn_rad);
}

TEST(Spread, IsThatOfTheSurestWay) {
  auto const steps_alone = steps_with_one_of(0.4);
  auto joined = steps_alone;
  joined.push_back({.from = 0, .to = steps, .from_to = {0.5 * steps, 0.0, 0.0}, .is_loop = true});
  DriftRates const rates;
  EXPECT_GT(drift_of_the_last(steps_alone, rates).turn_rad, 2.0 * rates.loop_turn_rad);
  EXPECT_DOUBLE_EQ(drift_of_the_last(joined, rates).turn_rad, rates.loop_turn_rad);
}

}  // namespace
}  // namespace lapwing::slam
