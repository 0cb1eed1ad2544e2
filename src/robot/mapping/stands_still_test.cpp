#include "robot/mapping/stands_still.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::robot {
namespace {

using slam::Pose2;

/// What a robot sees on its way along x through a room of 8 by 4 m, 1 m from its wall.
slam::testing::Drive through_a_room() {
  slam::testing::Building const room{
      {{-2, -1}, {6, -1}}, {{6, -1}, {6, 3}}, {{6, 3}, {-2, 3}}, {{-2, 3}, {-2, -1}}, {{1, 3}, {1, 2.5}}};
  return slam::testing::drive(room, {{0, 0}, {4, 0}},
                              {.beams = 360, .field_of_view_rad = 2.0 * std::numbers::pi, .most_range_m = 8.0});
}

Pose2 driven(slam::testing::Drive const& drive, std::size_t from, std::size_t to) {
  return slam::between(drive.log.scans[from].odometry, drive.log.scans[to].odometry);
}

TEST(StandsStill, IsSaidWhenAllAroundStaysAsItWas) {
  auto const drive = through_a_room();
  auto const& scans = drive.log.scans;
  auto const& sensor = drive.log.sensors.front();
  // The noise of the range differs, but not the place.
  auto again = scans[10];
  for (std::size_t i = 0; i < again.ranges_m.size(); ++i) again.ranges_m[i] += i % 2 == 0 ? 0.02F : -0.02F;
  EXPECT_TRUE(stands_still(scans[10], again, sensor, {.x = 0.2}));
  EXPECT_TRUE(stands_still(scans[10], again, sensor, {.x = -0.2, .y = 0.03, .yaw = 0.01}));
}

TEST(StandsStill, IsSaidWhereverTheScannersBearingsBegin) {
  // From 0 to a whole turn, and not from half a turn on one side to half a turn on the other.
  auto drive = through_a_room();
  auto sensor = drive.log.sensors.front();
  auto scan = drive.log.scans[10];
  auto const ahead = std::ssize(sensor.bearings_rad) / 2;
  std::ranges::rotate(scan.ranges_m, scan.ranges_m.begin() + ahead);
  std::ranges::rotate(sensor.bearings_rad, sensor.bearings_rad.begin() + ahead);
  for (auto& bearing : sensor.bearings_rad)
    if (bearing < 0.0F) bearing += static_cast<float>(2.0 * std::numbers::pi);
  ASSERT_TRUE(std::ranges::is_sorted(sensor.bearings_rad));
  EXPECT_TRUE(stands_still(scan, scan, sensor, {.x = 0.2}));
}

TEST(StandsStill, IsNotSaidOfARobotThatGetsOn) {
  auto const drive = through_a_room();
  for (std::size_t i = 0; i + 4 < drive.log.scans.size(); ++i)
    for (std::size_t const on : {1U, 2U, 4U})
      EXPECT_FALSE(stands_still(drive.log.scans[i], drive.log.scans[i + on], drive.log.sensors.front(),
                                driven(drive, i, i + on)))
          << i << " and " << on << " more";
}

TEST(StandsStill, IsNotSaidAfterATurnNorBeforeThereIsAWay) {
  auto const drive = through_a_room();
  auto const& scan = drive.log.scans[10];
  EXPECT_FALSE(stands_still(scan, scan, drive.log.sensors.front(), {.x = 0.2, .yaw = 0.1}));
  EXPECT_FALSE(stands_still(scan, scan, drive.log.sensors.front(), {.x = 0.05}));
}

TEST(StandsStill, IsNotSaidWhereOnlyThoseWhoWalkAlongStay) {
  slam::testing::Building const corridor{{{-20, -1}, {40, -1}}, {{-20, 1}, {40, 1}}};
  auto drive = slam::testing::drive(corridor, {{0, 0}, {10, 0}},
                                    {.beams = 360, .field_of_view_rad = 2.0 * std::numbers::pi, .most_range_m = 8.0});
  // One before the robot and one behind it, a metre and a half off.
  for (auto& scan : drive.log.scans)
    for (int degree = -9; degree <= 9; ++degree)
      for (int const beam : {180 + degree, (360 + degree) % 360}) scan.ranges_m[static_cast<std::size_t>(beam)] = 1.5F;
  EXPECT_FALSE(stands_still(drive.log.scans[5], drive.log.scans[7], drive.log.sensors.front(), driven(drive, 5, 7)));
}

TEST(StandsStill, IsNotSaidWhereNothingWasMeasured) {
  auto drive = through_a_room();
  auto blind = drive.log.scans[10];
  for (auto& range_m : blind.ranges_m) range_m = 0.0F;
  EXPECT_FALSE(stands_still(drive.log.scans[10], blind, drive.log.sensors.front(), {.x = 0.2}));
  EXPECT_FALSE(stands_still(blind, drive.log.scans[10], drive.log.sensors.front(), {.x = 0.2}));
}

}  // namespace
}  // namespace lapwing::robot
