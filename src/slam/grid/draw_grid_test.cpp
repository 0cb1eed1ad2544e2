// What a scan says of the cells that its beams cross, and of those between them.
#include "slam/grid/draw_grid.hpp"

#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

constexpr float reach_m = 10.0F;

/// Beams all around, or in `fov_rad` ahead.
Sensor scanner(int beams, double fov_rad = 2.0 * std::numbers::pi) {
  Sensor sensor{.bearings_rad = {}, .no_return_m = reach_m};
  for (int i = 0; i < beams; ++i) sensor.bearings_rad.push_back(static_cast<float>(-fov_rad / 2 + i * fov_rad / beams));
  return sensor;
}

/// The map of one scan from the origin.
map::OccupancyGrid drawn(Sensor const& sensor, std::function<double(double bearing)> const& range_at) {
  Scan scan;
  for (float const bearing : sensor.bearings_rad)
    scan.ranges_m.push_back(std::min(reach_m, static_cast<float>(range_at(bearing))));
  return draw_grid({.sensors = {sensor}, .scans = {scan}}, {Pose2{}}, {});
}

/// Of a corridor 3 m wide that goes on without end ahead and behind.
double corridor_m(double bearing) {
  return 1.5 / std::max(1e-6, std::abs(std::sin(bearing)));
}

/// Of a hall, from 1.5 m before the middle of its wall: 14 m wide, 12 m deep, with a pillar 7 m off on either side.
double hall_m(double bearing) {
  constexpr double pillar_rad = 0.43;
  if (std::abs(std::abs(bearing) - pillar_rad) < 0.04) return 7.0;
  double const ahead = std::cos(bearing);
  double const to_the_end = ahead > 0.0 ? 10.5 / ahead : -1.5 / ahead;
  return std::min(to_the_end, 7.0 / std::max(1e-6, std::abs(std::sin(bearing))));
}

bool is_free(map::OccupancyGrid const& grid, double x, double y) {
  auto const evidence = grid.at(grid.cell_at({x, y}));
  return evidence.is_seen() && evidence.log_odds() < 0.0;
}

bool is_seen(map::OccupancyGrid const& grid, double x, double y) {
  return grid.at(grid.cell_at({x, y})).is_seen();
}

TEST(DrawGrid, SaysThatACorridorIsFreeAheadThoughItIsLongerThanTheSensorSees) {
  auto const grid = drawn(scanner(360), corridor_m);
  for (double x = -9.0; x < 9.0; x += 0.05)
    for (double y = -1.0; y <= 1.0; y += 0.05) EXPECT_TRUE(is_free(grid, x, y)) << x << ' ' << y;
  EXPECT_FALSE(is_seen(grid, 10.2, 0.0));
}

TEST(DrawGrid, SaysThatAHallIsFreeAheadThoughPillarsStandInIt) {
  auto const grid = drawn(scanner(360), hall_m);
  for (double x = 0.0; x < 6.0; x += 0.05)
    for (double y = -1.0; y <= 1.0; y += 0.05) EXPECT_TRUE(is_free(grid, x, y)) << x << ' ' << y;
  EXPECT_FALSE(is_seen(grid, 8.5, 0.0)) << "farther off than the pillars";
}

TEST(DrawGrid, SaysNothingOfAWideGap) {
  // A black wall may be as long as that; whoever stands near it has nothing ahead, and far walls on both sides.
  auto const grid = drawn(scanner(360), [](double bearing) { return std::abs(bearing) < 1.1 ? 99.0 : 9.0; });
  EXPECT_FALSE(is_seen(grid, 2.0, 0.0));
}

TEST(DrawGrid, SaysNothingOfWhatSwallowsLight) {
  // Something black stands before a wall that is well within reach.
  auto const grid = drawn(scanner(360), [](double bearing) { return std::abs(bearing) < 0.2 ? 99.0 : 4.0; });
  EXPECT_FALSE(is_seen(grid, 2.0, 0.0));
  EXPECT_TRUE(is_free(grid, 0.0, 2.0));
}

TEST(DrawGrid, SaysNothingBesideWhereAScannerLooks) {
  // It sees three quarters of a circle, and nothing comes back from its last beams.
  auto const grid = drawn(scanner(315, 5.5), [](double bearing) { return bearing > 2.5 ? 99.0 : 9.5; });
  EXPECT_TRUE(is_free(grid, 5.0, 0.0));
  EXPECT_FALSE(is_seen(grid, 5.0 * std::cos(2.6), 5.0 * std::sin(2.6)));
}

TEST(DrawGrid, LeavesNoGapsBetweenBeams) {
  auto const grid = drawn(scanner(360), [](double) { return 8.0; });
  for (double bearing = 0.0; bearing < 6.28; bearing += 0.003)
    EXPECT_TRUE(is_free(grid, 7.5 * std::cos(bearing), 7.5 * std::sin(bearing))) << bearing;
}

TEST(DrawGrid, TakesTheNearerOfTwoBeamsForWhatIsBetweenThem) {
  auto const sensor = scanner(360);
  auto const step = sensor.bearings_rad[1] - sensor.bearings_rad[0];
  auto const grid = drawn(sensor, [](double bearing) { return bearing > -1e-3 ? 8.0 : 5.0; });
  double const middle = -0.5 * step;
  EXPECT_TRUE(is_free(grid, 4.5 * std::cos(middle), 4.5 * std::sin(middle)));
  EXPECT_FALSE(is_free(grid, 7.0 * std::cos(middle), 7.0 * std::sin(middle)));
}

TEST(DrawGrid, SaysNothingWhereASonarHearsNothing) {
  // A smooth wall that a sonar looks at aslant sends nothing back, wherever it is.
  auto const sensor = scanner(24);
  auto const grid = drawn(sensor, [](double bearing) { return std::abs(bearing) < 0.1 ? 99.0 : 9.5; });
  EXPECT_FALSE(is_seen(grid, 3.0, 0.0));
}

TEST(DrawGrid, SaysNothingBetweenSingleRangers) {
  auto const grid = drawn(scanner(4), [](double) { return 3.0; });
  EXPECT_TRUE(is_free(grid, 2.0, 0.0));
  EXPECT_FALSE(is_seen(grid, 1.5, 1.5));
}

TEST(DrawGrid, KnowsTheWayToWhatIsFartherThanItDraws) {
  Sensor sensor = scanner(360);
  sensor.no_return_m = 80.0F;
  Scan scan;
  scan.ranges_m.assign(360, 30.0F);
  auto const grid = draw_grid({.sensors = {sensor}, .scans = {scan}}, {Pose2{}}, {.most_range_m = 20.0});
  EXPECT_TRUE(is_free(grid, 19.0, 0.0));
  EXPECT_FALSE(is_seen(grid, 21.0, 0.0));
}

TEST(DrawGrid, SilenceOfASingleRangerIsAHintForTheNextStep) {
  auto const grid = drawn(scanner(4), [](double) { return 100.0; });
  EXPECT_TRUE(is_free(grid, 1.0, 0.0));
  EXPECT_GT(grid.at(grid.cell_at({1.0, 0.0})).log_odds(), -0.1);
  EXPECT_FALSE(is_seen(grid, 1.7, 0.0));
}

TEST(DrawGrid, DrawsNothingOfAScanOfWhichNothingWasKept) {
  // As those of a mapping that goes on from its state.
  auto const grid = draw_grid({.sensors = {scanner(360)}, .scans = {Scan()}}, {Pose2{}}, {});
  EXPECT_FALSE(is_seen(grid, 0.0, 0.0));
}

TEST(DrawGrid, SilenceAllRoundIsAHintForTheNextStep) {
  // In the middle of a hall that is larger than the scanner sees.
  auto const round = drawn(scanner(360), [](double) { return 99.0; });
  auto const ahead = drawn(scanner(180, std::numbers::pi), [](double) { return 99.0; });
  for (double bearing = -1.5; bearing < 1.5; bearing += 0.01) {
    EXPECT_TRUE(is_free(round, 1.2 * std::cos(bearing), 1.2 * std::sin(bearing))) << bearing;
    EXPECT_TRUE(is_free(ahead, 1.2 * std::cos(bearing), 1.2 * std::sin(bearing))) << bearing;
  }
  EXPECT_FALSE(is_seen(round, 1.8, 0.0));
  EXPECT_FALSE(is_seen(ahead, -0.5, 0.0)) << "where it does not look";
}

TEST(DrawGrid, SilenceOnOneSideIsAHintForTheNextStep) {
  // The side walls of a hall are too far away, the other two are seen from the middle.
  auto const far_walls = drawn(scanner(360), [](double bearing) {
    double const wall_m = 9.0 / std::max(1e-6, std::abs(std::sin(bearing)));
    return wall_m < reach_m ? wall_m : 99.0;
  });
  EXPECT_TRUE(is_free(far_walls, 1.3, 0.0));
  EXPECT_TRUE(is_free(far_walls, -1.3, 0.0));
  EXPECT_FALSE(is_seen(far_walls, 1.8, 0.0));
  // It stands beside the only pillar: nothing flat is as wide as the rest.
  auto const pillar = drawn(scanner(360), [](double bearing) { return std::abs(bearing) < 0.5 ? 0.8 : 99.0; });
  EXPECT_TRUE(is_free(pillar, -1.3, 0.0));
  EXPECT_FALSE(is_seen(pillar, 1.3, 0.0));
}

TEST(DrawGrid, SaysNothingBeforeABlackWallBetweenNearThings) {
  auto const grid = drawn(scanner(360), [](double bearing) { return std::abs(bearing) < 1.2 ? 99.0 : 2.0; });
  EXPECT_FALSE(is_seen(grid, 0.5, 0.0));
}

}  // namespace
}  // namespace lapwing::slam
