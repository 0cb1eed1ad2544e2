// What sonars say of the cells in their cones.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "slam/grid/draw_grid.hpp"

namespace lapwing::slam {
namespace {

constexpr float no_echo_m = 5.0F;

/// One sonar that looks ahead; a scan from each place along x, 5 cm apart from the origin.
map::OccupancyGrid drawn(std::vector<float> const& ranges_m) {
  Sensor const sonar{.bearings_rad = {0.0F}, .no_return_m = no_echo_m, .half_cone_rad = 0.13F};
  ScanLog log{.sensors = {sonar}, .scans = {}};
  std::vector<Pose2> poses;
  for (auto const range : ranges_m) {
    Scan scan;
    scan.ranges_m = {range};
    log.scans.push_back(scan);
    poses.push_back({0.05 * static_cast<double>(poses.size()), 0.0, 0.0});
  }
  return draw_grid(log, poses, {});
}

double log_odds(map::OccupancyGrid const& grid, double x, double y) {
  return grid.at(grid.cell_at({x, y})).log_odds();
}
bool is_seen(map::OccupancyGrid const& grid, double x, double y) {
  return grid.at(grid.cell_at({x, y})).is_seen();
}

TEST(DrawCone, EchoMeansSomethingSomewhereOnItsArcAndNothingBeforeIt) {
  auto const grid = drawn({2.0F});
  EXPECT_GT(log_odds(grid, 2.0, 0.0), 0.05);
  EXPECT_GT(log_odds(grid, 2.0, 0.12), 0.0) << "off the axis, too";
  EXPECT_LT(log_odds(grid, 1.0, 0.0), 0.0);
  EXPECT_LT(log_odds(grid, 1.5, 0.1), 0.0) << "a cone is wide";
  EXPECT_LT(log_odds(grid, 1.5, 0.0), log_odds(grid, 1.5, 0.1)) << "and surer along its axis";
  EXPECT_FALSE(is_seen(grid, 1.5, 0.4)) << "beside the cone";
  EXPECT_FALSE(is_seen(grid, 2.3, 0.0)) << "behind the echo";
  EXPECT_FALSE(is_seen(grid, -0.2, 0.0));
}

TEST(DrawCone, SeveralEchoesOfOneThingOutweighTheWayBeforeThem) {
  // A wall ahead, nearer with each step.
  auto const grid = drawn({1.0F, 0.95F, 0.9F, 0.85F, 0.8F, 0.75F, 0.7F});
  EXPECT_GT(log_odds(grid, 1.0, 0.0), 1.0);
  EXPECT_LT(log_odds(grid, 0.8, 0.0), -0.2);
}

TEST(DrawCone, OfAFarEchoOnlyTheNearPartIsDrawn) {
  auto const grid = drawn({4.8F});
  EXPECT_LT(log_odds(grid, 3.0, 0.0), 0.0);
  EXPECT_FALSE(is_seen(grid, 4.5, 0.0));
  EXPECT_FALSE(is_seen(grid, 4.8, 0.0)) << "an arc more than a metre long says where nothing is";
}

TEST(DrawCone, SilenceIsAHintForTheNextStep) {
  auto const silent = drawn({no_echo_m});
  EXPECT_LT(log_odds(silent, 1.0, 0.0), 0.0);
  EXPECT_GT(log_odds(silent, 1.0, 0.0), -0.05);
  EXPECT_FALSE(is_seen(silent, 2.0, 0.0));
  // Silent at first, as a wall is that is met aslant; then it is heard.
  auto const heard = drawn({no_echo_m, no_echo_m, no_echo_m, 0.85F});
  EXPECT_GT(log_odds(heard, 1.0, 0.0), 0.0);
}

TEST(DrawCone, SilenceGoesNoFartherThanWhatIsHeardBesideIt) {
  Sensor const sonars{.bearings_rad = {0.0F, 1.0F}, .no_return_m = no_echo_m, .half_cone_rad = 0.13F};
  Scan scan;
  scan.ranges_m = {no_echo_m, 0.8F};
  auto const grid = draw_grid({.sensors = {sonars}, .scans = {scan}}, {Pose2{}}, {});
  EXPECT_LT(log_odds(grid, 0.6, 0.0), 0.0);
  EXPECT_FALSE(is_seen(grid, 1.0, 0.0)) << "the same wall may go on there, aslant";
}

TEST(DrawCone, ASonarThatIsNotBelievedDrawsNothing) {
  EXPECT_TRUE(drawn({std::numeric_limits<float>::quiet_NaN()}).tiles().empty());
}

}  // namespace
}  // namespace lapwing::slam
