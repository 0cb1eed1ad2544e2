#include "robot/mapping/who_walks.hpp"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "robot/mapping/floor_map.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::robot {
namespace {

/// A robot that has come 6 m along a corridor with doorways.
struct WhoWalks : ::testing::Test {
  WhoWalks() {
    for (std::size_t i = 0; i + 1 < drive.log.scans.size(); ++i) map.add(drive.log.scans[i]);
    pose = map.here().pose * slam::between(map.odometry(), scan.odometry);
  }
  /// In the scan, half a metre wide, seen at that bearing.
  void put(float bearing_rad, float range_m) {
    float const half_rad = std::atan(0.25F / range_m);
    auto const& bearings = map.sensor().bearings_rad;
    for (std::size_t i = 0; i < bearings.size(); ++i)
      if (std::abs(geo::wrap_pi(bearings[i] - bearing_rad)) < half_rad)
        scan.ranges_m[i] = std::min(scan.ranges_m[i], range_m);
  }
  [[nodiscard]] slam::Scan rest(slam::Pose2 const& at) const {
    return without_who_walks(scan, map.sensor(), at, map.graph());
  }
  [[nodiscard]] static long left_out(slam::Scan const& scan) { return std::ranges::count(scan.ranges_m, 0.0F); }

  slam::testing::Drive drive =
      slam::testing::drive(slam::testing::comb(5, 6.0, 3.0), {{0, 0}, {6, 0}},
                           {.beams = 360, .field_of_view_rad = 2.0 * std::numbers::pi, .most_range_m = 8.0});
  FloorMap map{drive.log.sensors.front(), {}};
  slam::Scan scan = drive.log.scans.back();
  slam::Pose2 pose;
};

TEST_F(WhoWalks, LeavesWallsInTheScan) {
  EXPECT_LT(left_out(rest(pose)), left_out(scan) + 4);
}

TEST_F(WhoWalks, LeavesOutWhoFollows) {
  put(std::numbers::pi_v<float>, 0.7F);
  auto const shown = left_out(scan);
  auto const gone = left_out(rest(pose)) - shown;
  EXPECT_GT(gone, 20);
  EXPECT_LT(gone, 44) << "of the 39 beams that he takes";
}

TEST_F(WhoWalks, LeavesAScanAsItIsWhenThePoseMustBeWrong) {
  auto const turned = pose * slam::Pose2{0.0, 0.0, 0.3};
  EXPECT_EQ(rest(turned).ranges_m, scan.ranges_m);
}

TEST_F(WhoWalks, SaysNothingOfPlacesThatNobodySaw) {
  FloorMap const nothing_yet(map.sensor(), {});
  EXPECT_EQ(without_who_walks(scan, map.sensor(), pose, nothing_yet.graph()).ranges_m, scan.ranges_m);
}

}  // namespace
}  // namespace lapwing::robot
