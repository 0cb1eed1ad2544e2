#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sim/building/sensors/imu.hpp"
#include "sim/building/sensors/laser.hpp"
#include "sim/building/sensors/sonar.hpp"

namespace lapwing::sim::building {
namespace {

constexpr double us_per_m = 147.0 / 0.0254;

/// A wall 20 m wide, at x = `far_m` straight ahead, its right end turned away by `aslant_rad`.
FaceIndex wall_ahead(double far_m, double aslant_rad = 0.0, Material material = Material::plaster) {
  Shift const along(-std::sin(aslant_rad), -std::cos(aslant_rad));
  Place const middle(far_m, 0.0);
  return FaceIndex({{.from = middle - 10.0 * along, .to = middle + 10.0 * along, .material = material}});
}

struct Spread {
  double mean = 0.0;
  double deviation = 0.0;
};

Spread spread_of(std::vector<double> const& values) {
  Spread spread;
  auto const count = static_cast<double>(values.size());
  for (double const value : values) spread.mean += value / count;
  for (double const value : values) spread.deviation += (value - spread.mean) * (value - spread.mean) / count;
  spread.deviation = std::sqrt(spread.deviation);
  return spread;
}

TEST(Laser, HasTheNoiseOfItsSettings) {
  auto const wall = wall_ahead(4.0);
  Surroundings const around{.fixed = wall};
  Laser laser({.noise_m = 0.02, .noise_per_m = 0.005, .lost = 0.1}, 1, 0);
  std::vector<double> ranges;
  int lost = 0;
  for (int i = 0; i < 20'000; ++i) {
    auto const range = laser.range_mm({0, 0}, 0.0, around);
    if (range == 0)
      ++lost;
    else
      ranges.push_back(range / 1e3);
  }
  auto const spread = spread_of(ranges);
  EXPECT_NEAR(spread.mean, 4.0, 0.002);
  EXPECT_NEAR(spread.deviation, 0.02 + 4.0 * 0.005, 0.001);
  EXPECT_NEAR(lost / 20'000.0, 0.1, 0.01);
}

TEST(Laser, MissesDarkThingsTheMoreTheFartherTheyAre) {
  auto const lost_at = [](double far_m) {
    auto const wall = wall_ahead(far_m, 0.0, Material::dark);
    Surroundings const around{.fixed = wall};
    Laser laser({.range_m = 10.0, .lost_on_dark = 0.5}, 1, 0);
    int lost = 0;
    for (int i = 0; i < 5'000; ++i) lost += laser.range_mm({0, 0}, 0.0, around) == 0 ? 1 : 0;
    return lost / 5'000.0;
  };
  EXPECT_NEAR(lost_at(2.0), 0.2, 0.03);
  EXPECT_NEAR(lost_at(5.0), 0.5, 0.03);
  EXPECT_NEAR(lost_at(9.0), 0.9, 0.03);
}

TEST(Laser, SeesThroughGlassButWhereItMeetsItSquarely) {
  // A pane 1 cm thick before a wall.
  auto const seen = [](double yaw_rad) {
    FaceIndex const pane({{.from = {2.0, 5.0}, .to = {2.0, -5.0}, .material = Material::glass},
                          {.from = {2.01, -5.0}, .to = {2.01, 5.0}, .material = Material::glass},
                          {.from = {3.0, 5.0}, .to = {3.0, -5.0}}});
    Laser laser({.noise_m = 0.0, .noise_per_m = 0.0, .lost = 0.0}, 1, 0);
    return std::cos(yaw_rad) * laser.range_mm({0, 0}, yaw_rad, {.fixed = pane});
  };
  EXPECT_NEAR(seen(0.0), 2000.0, 1.0);
  EXPECT_NEAR(seen(0.05), 2000.0, 1.0);
  EXPECT_NEAR(seen(0.15), 3000.0, 1.0);
  EXPECT_NEAR(seen(-0.8), 3000.0, 1.0);
}

TEST(Laser, HasNowAndThenSomethingBetweenTheTwoSidesOfAnEdge) {
  // To the left of straight ahead a wall is 2 m away, to the right one 4 m.
  FaceIndex const edge({{.from = {2.0, 5.0}, .to = {2.0, 0.005}}, {.from = {4.0, 5.0}, .to = {4.0, -5.0}}});
  LaserSettings const settings{.beams = 3,
                               .first_angle_rad = -0.0175,
                               .step_rad = 0.0175,
                               .period_s = 0.1,
                               .duration_s = 0.0,
                               .noise_m = 0.0,
                               .noise_per_m = 0.0,
                               .lost = 0.0,
                               .spot_rad = 0.005};
  Laser laser(settings, 1, 0);
  int between = 0;
  constexpr int scans = 2000;
  for (int i = 0; i < scans; ++i) {
    ASSERT_TRUE(laser.sense(0.1 * i, {}, {.fixed = edge}));
    auto const& ranges = laser.scan().ranges_mm;
    EXPECT_NEAR(ranges[0], 4000, 3);
    EXPECT_NEAR(ranges[1], 4000, 3);
    EXPECT_GE(ranges[2], 2000);
    EXPECT_LE(ranges[2], 4000);
    between += ranges[2] > 2010 ? 1 : 0;
  }
  EXPECT_NEAR(between / double{scans}, 0.005 / 0.0175, 0.04) << "as often as the edge lies within the beam";
}

TEST(Laser, SeesNothingBeyondItsRange) {
  auto const wall = wall_ahead(4.2);
  Laser ring(tof_ring(), 1, 0);
  EXPECT_EQ(ring.range_mm({0, 0}, 0.0, {.fixed = wall}), 0);
  EXPECT_EQ(ring.range_mm({0, 0}, std::numbers::pi, {.fixed = wall}), 0);
}

TEST(Laser, MeasuresBeamByBeamWhileTheRobotTurns) {
  auto const wall = wall_ahead(2.0);
  Surroundings const around{.fixed = wall};
  LaserSettings const settings{.beams = 100, .noise_m = 0.0, .noise_per_m = 0.0, .lost = 0.0};
  Laser laser(settings, 1, 0);
  std::vector<double> begins_s;
  // It turns against the scanner, just as fast: all beams of the first scan look the same way, within a step's turn.
  double const rate = -settings.step_rad * settings.beams / settings.duration_s;
  for (int i = 0; i <= 40; ++i) {
    double const t = 0.005 * i;
    if (!laser.sense(t, {{0, 0}, -settings.first_angle_rad + rate * t}, around)) continue;
    begins_s.push_back(laser.scan().time_s);
    ASSERT_EQ(laser.scan().ranges_mm.size(), 100U);
    if (begins_s.size() > 1) continue;
    for (auto const range : laser.scan().ranges_mm) EXPECT_NEAR(range, 2'000, 10);
  }
  ASSERT_EQ(begins_s.size(), 2U);
  EXPECT_NEAR(begins_s[1], 0.1, 1e-9);
}

TEST(Sonar, TellsTheRangeAsThePulseWidthOfTheSeed) {
  auto const wall = wall_ahead(1.0);
  Noise noise(1, "test");
  std::vector<double> ranges;
  for (int i = 0; i < 5'000; ++i) {
    auto const echo = echo_us({.noise_m = 0.008, .lost = 0.0}, {0, 0}, 0.0, {.fixed = wall}, noise);
    ranges.push_back(echo / us_per_m);
  }
  auto const spread = spread_of(ranges);
  EXPECT_NEAR(spread.mean, 1.0, 0.001);
  EXPECT_NEAR(spread.deviation, 0.008, 0.0005);
}

TEST(Sonar, IsMirroredAwayByASmoothWallMetAslant) {
  Noise noise(1, "test");
  SonarSettings const sonar{.lost = 0.0, .second_echo = 0.0};
  auto const straight = wall_ahead(2.0, 0.2);
  auto const aslant = wall_ahead(2.0, 0.8);
  auto const cloth = wall_ahead(2.0, 0.8, Material::cloth);
  auto const far_cloth = wall_ahead(3.5, 0.0, Material::cloth);
  auto const glass = wall_ahead(2.0, 0.2, Material::glass);
  EXPECT_GT(echo_us(sonar, {0, 0}, 0.0, {.fixed = straight}, noise), 0);
  EXPECT_GT(echo_us(sonar, {0, 0}, 0.0, {.fixed = glass}, noise), 0);
  EXPECT_EQ(echo_us(sonar, {0, 0}, 0.0, {.fixed = aslant}, noise), 0);
  EXPECT_GT(echo_us(sonar, {0, 0}, 0.0, {.fixed = cloth}, noise), 0);
  EXPECT_EQ(echo_us(sonar, {0, 0}, 0.0, {.fixed = far_cloth}, noise), 0);
}

TEST(Sonar, HearsWhatStandsBesideItsAxisWithinItsCone) {
  FaceIndex const nothing({});
  Noise noise(1, "test");
  SonarSettings const sonar{.half_cone_rad = 0.13, .noise_m = 0.0, .lost = 0.0};
  auto const at = [&](double angle_rad) {
    return echo_us(sonar, {0, 0}, 0.0,
                   {.fixed = nothing,
                    .posts = {{.middle = {1.5 * std::cos(angle_rad), 1.5 * std::sin(angle_rad)}, .radius_m = 0.05}}},
                   noise);
  };
  EXPECT_NEAR(at(0.0), 1.45 * us_per_m, 10.0);
  EXPECT_GT(at(0.12), 0);
  EXPECT_EQ(at(0.25), 0);
}

TEST(Sonar, ComesBackOverASecondWallLonger) {
  // A mirror at 45 degrees throws it to the left, where a wall stands across.
  FaceIndex const corner({{.from = {3.0, 1.0}, .to = {1.0, -1.0}}, {.from = {1.0, 1.5}, .to = {3.0, 1.5}}});
  Noise noise(1, "test");
  SonarSettings const sonar{.range_m = 7.5, .lost = 0.0, .second_echo = 1.0};
  SonarSettings const without{.range_m = 7.5, .lost = 0.0, .second_echo = 0.0};
  EXPECT_EQ(echo_us(without, {0, 0}, 0.0, {.fixed = corner}, noise), 0);
  EXPECT_NEAR(echo_us(sonar, {0, 0}, 0.0, {.fixed = corner}, noise) / us_per_m, 3.5, 0.1);
}

TEST(Imu, DriftsAsItsBiasAndStandsUpright) {
  FaceIndex const nothing({});
  DrivenBody const still({}, {}, 1, 0);
  ImuSettings const settings{.gyro_bias_rad_s = 0.001, .gyro_drift_rad_s_sqrt_s = 0.0, .tilt_rad = 0.0};
  std::vector<double> yaws;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Imu imu(settings, seed, 0);
    Imu::Sample sample;
    for (int i = 0; i < 6'000; ++i) sample = imu.sense(0.01, still);
    yaws.push_back(2.0 * std::atan2(sample.orientation[3], sample.orientation[0]));
    EXPECT_NEAR(sample.acceleration_m_s2[2], 9.81, 0.4);
  }
  EXPECT_NEAR(spread_of(yaws).deviation, 0.06, 0.008);
}

TEST(Imu, HasTheNoiseOfItsSettings) {
  DrivenBody const still({}, {}, 1, 0);
  Imu imu({.gyro_noise_rad_s = 0.004, .acceleration_noise_m_s2 = 0.07}, 1, 0);
  std::vector<double> rates;
  std::vector<double> forces;
  for (int i = 0; i < 10'000; ++i) {
    auto const sample = imu.sense(0.01, still);
    rates.push_back(sample.rate_rad_s[0]);
    forces.push_back(sample.acceleration_m_s2[1]);
  }
  EXPECT_NEAR(spread_of(rates).deviation, 0.004, 0.0002);
  EXPECT_NEAR(spread_of(forces).deviation, 0.07, 0.003);
}

TEST(Imu, FollowsATurn) {
  FaceIndex const nothing({});
  Surroundings const around{.fixed = nothing};
  DrivenBody body({.motor_spread = 0.0, .slip_m_per_sqrt_m = 0.0}, {}, 1, 0);
  Imu imu({}, 1, 0);
  Imu::Sample sample;
  for (int i = 0; i < 400; ++i) {
    (void)body.step(0.005, -0.5, 0.5, around);
    if (i % 2 == 1) sample = imu.sense(0.01, body);
  }
  double const yaw = 2.0 * std::atan2(sample.orientation[3], sample.orientation[0]);
  EXPECT_NEAR(geo::wrap_pi(yaw - body.pose().yaw_rad), 0.0, 0.02);
}

}  // namespace
}  // namespace lapwing::sim::building
