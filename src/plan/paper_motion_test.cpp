#include "plan/paper_motion.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "plan/estimate.hpp"
#include "plan/mission_builder.hpp"

namespace lapwing::plan {
namespace {

constexpr Performance nimble{.cruise_m_s = 10.0, .accel_m_s2 = 2.5, .brake_m_s2 = 2.5, .vertical_accel_m_s2 = 1.0};

TEST(LegTime, IsThatOfATrapezium) {
  EXPECT_NEAR(leg_time_s(100.0, 0.0, 0.0, nimble), 14.0, 1e-9);  // 4 s up, 4 s down, 60 m even
  EXPECT_NEAR(leg_time_s(100.0, 10.0, 10.0, nimble), 10.0, 1e-9);
  EXPECT_NEAR(leg_time_s(10.0, 0.0, 0.0, nimble), 4.0, 1e-9);  // 5 m/s at the most
  EXPECT_NEAR(leg_time_s(100.0, 0.0, 0.0, {}), 10.0, 1e-9);
}

// Numerically: flies the speed profile in small steps and measures how far it comes.
TEST(LegTime, CoversTheLegForAnyEntryAndExit) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> speed(-8.0, 9.0);
  std::uniform_real_distribution<double> length(60.0, 300.0);
  for (int round = 0; round < 100; ++round) {
    double const entry = speed(random);
    double const exit = std::abs(speed(random));
    double const leg = length(random);
    double const time = leg_time_s(leg, entry, exit, nimble);
    double way = 0.0;
    double const dt = 1e-3;
    for (double t = 0.0; t < time; t += dt) {
      double const up = entry + nimble.accel_m_s2 * t;
      double const down = exit + nimble.brake_m_s2 * (time - t);
      way += std::min({up, down, nimble.cruise_m_s}) * dt;
    }
    EXPECT_NEAR(way, leg, 0.1);
  }
}

TEST(VerticalTime, KnowsRampsAndDirections) {
  EXPECT_EQ(vertical_time_s(0.0, nimble), 0.0);
  EXPECT_NEAR(vertical_time_s(25.0, nimble), 12.5, 1e-9);
  EXPECT_NEAR(vertical_time_s(-15.0, nimble), 11.5, 1e-9);
  EXPECT_NEAR(vertical_time_s(1.0, nimble), 2.0, 1e-9);
}

TEST(Curves, TurnNoTighterThanTheyCan) {
  auto const plane = performance_of(vehicle::Family::plane);
  Curves curves(plane, 0.0);
  auto const leg = curves.go_to({-1000.0, 0.0, 0.0}, plane.waypoint_radius_m);
  double const half_circle_m = std::numbers::pi * plane.cruise_m_s / plane.turn_rate_rad_s;
  EXPECT_GT(leg.path_m, 950.0 + half_circle_m - 100.0);
  EXPECT_LT(leg.path_m, 950.0 + 2.0 * half_circle_m);
  EXPECT_LE(std::hypot(curves.place().north + 1000.0, curves.place().east), plane.waypoint_radius_m + 5.0);
}

TEST(Curves, GiveUpWhatTheyCannotReach) {
  auto const plane = performance_of(vehicle::Family::plane);
  Curves curves(plane, 0.0);
  EXPECT_LT(curves.go_to({0.0, 30.0, 0.0}, 0.1).time_s, 100.0);
}

struct DetailedEstimate : ::testing::Test {
  static Estimate of(vehicle::Family family, MissionBuilder const& builder) {
    return estimate(*builder.finish("m"), std::nullopt, performance_of(family));
  }
  geo::Wgs84 home = geo::Wgs84::from_degrees(40.0, -8.0, 100.0);
  geo::Wgs84 above = geo::Wgs84::from_degrees(40.0, -8.0, 130.0);
};

TEST_F(DetailedEstimate, CountsTakeOffAndLanding) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(home));
  ASSERT_TRUE(builder.take_off(above, 0.0));
  ASSERT_TRUE(builder.land(home, 0.0, 0));
  auto const copter = of(vehicle::Family::copter, builder);
  EXPECT_NEAR(copter.path_m, 60.0, 1e-6);
  // 3 s of spooling up, 12 s of climb and its ramps, 20 m at 1.5 m/s and 10 m at 0.5 m/s down, 2 s to be landed.
  EXPECT_NEAR(base::to_seconds(copter.duration), 3.0 + 12.0 + 2.5 / 0.8 + 20.0 / 1.5 + 20.0 + 2.0, 0.01);
  EXPECT_EQ(base::to_seconds(of(vehicle::Family::rover, builder).duration), 0.0);
}

TEST_F(DetailedEstimate, WingsAreSlowerThanTheirSpeedRoundCorners) {
  MissionBuilder builder;
  ASSERT_TRUE(builder.home(above));
  for (int i = 0; i < 6; ++i)
    ASSERT_TRUE(builder.waypoint(*builder.from_last({.north_m = i % 2 == 0 ? 500.0 : -500.0, .east_m = 30.0})));
  auto const plane = of(vehicle::Family::plane, builder);
  EXPECT_GT(plane.path_m, 6 * 500.0);
  EXPECT_FALSE(plane.is_endless);
}

TEST_F(DetailedEstimate, TextTellsBoth) {
  Flown const flown{{90.0, std::chrono::seconds(110), false}, 100.0, std::chrono::seconds(100)};
  EXPECT_EQ(to_text(flown), "100 s and 100 m flown, 110 s (+10 %) and 90 m (-10 %) estimated");
}

}  // namespace
}  // namespace lapwing::plan
