#include "slam/match/odometry_bias.hpp"

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

testing::Drive pulled_to_one_side(double turn_per_m) {
  auto const building = testing::office(20.0, 12.0, 4.0, 1.0, 5);
  return testing::drive(building, {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {0, 0}},
                        {.beams = 11, .most_range_m = 5.0, .turn_bias_per_m = turn_per_m});
}

std::vector<Pose2> odometry_of(ScanLog const& log) {
  std::vector<Pose2> poses;
  for (auto const& scan : log.scans) poses.push_back(scan.odometry);
  return poses;
}

TEST(OdometryBias, IsSeenFromWallsThatItBends) {
  auto const drive = pulled_to_one_side(0.06);
  auto const odometry = odometry_of(drive.log);
  auto const bias = find_bias(drive.log, odometry);
  EXPECT_NEAR(bias.turn_per_m, -0.06, 0.02);
  EXPECT_LT(testing::greatest_error_m(without_bias(odometry, bias), drive.truth),
            0.5 * testing::greatest_error_m(odometry, drive.truth));
}

TEST(OdometryBias, OfNothingIsNothing) {
  EXPECT_EQ(find_bias({}, {}).turn_per_m, 0.0);
  EXPECT_TRUE(without_bias({}, {0.1, 0.1}).empty());
}

}  // namespace
}  // namespace lapwing::slam
