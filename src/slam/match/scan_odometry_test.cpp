#include "slam/match/scan_odometry.hpp"

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// After 24 m: how far the last scan is told to be from where it was taken.
double scan_odometry_error_m(testing::Drive const& drive) {
  ScanOdometry odometry;
  Pose2 pose;
  for (auto const& scan : drive.log.scans) pose = odometry.follow(frame_of(scan, drive.log.sensors[0], {}), scan.time);
  return distance_m(pose, between(drive.truth.front(), drive.truth.back()));
}

testing::Drive scanned_round_a_corner() {
  return testing::drive(testing::office(20.0, 12.0, 4.0, 1.0, 3), {{0.0, 0.0}, {16.0, 0.0}, {16.0, 8.0}}, {});
}

TEST(ScanOdometry, FollowsARobotThatTellsNone) {
  EXPECT_LT(scan_odometry_error_m(scanned_round_a_corner()), 1.5);
}

TEST(ScanOdometry, StampsThatComeInBurstsAreNoSpeed) {
  auto drive = scanned_round_a_corner();
  // Of three scans that were taken evenly, a buffer gives two the third one's time.
  for (std::size_t k = 0; k < drive.log.scans.size(); ++k)
    if (k % 3 != 2 && k + 2 - k % 3 < drive.log.scans.size())
      drive.log.scans[k].time = drive.log.scans[k + 2 - k % 3].time - LogTime(0.01 * static_cast<double>(2 - k % 3));
  EXPECT_LT(scan_odometry_error_m(drive), 1.5);
}

}  // namespace
}  // namespace lapwing::slam
