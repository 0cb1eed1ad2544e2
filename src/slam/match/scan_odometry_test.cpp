#include "slam/match/scan_odometry.hpp"

#include <gtest/gtest.h>

#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

/// How far the last scan is told to be from where it was taken.
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

/// A buffer gives scans that were taken evenly almost the last one's time.
void come_in_bursts(ScanLog& log, std::size_t of, LogTime apart) {
  for (std::size_t k = 0; k < log.scans.size(); ++k) {
    auto const last = k - k % of + of - 1;
    if (last < log.scans.size()) log.scans[k].time = log.scans[last].time - static_cast<double>(last - k) * apart;
  }
}

/// Walls in all directions, so that nothing may slide.
testing::Drive scanned_round_a_room(double turn_rad_per_scan) {
  testing::Building const room{{{-1, -1}, {9, -1}}, {{9, -1}, {9, 7}}, {{9, 7}, {-1, 7}}, {{-1, 7}, {-1, -1}},
                               {{3, 2}, {5, 2}},    {{5, 2}, {5, 4}},  {{2, 4}, {2, 5}},  {{6.5, 1}, {7.5, 1.5}}};
  return testing::drive(room, {{0, 0}, {8, 0}, {8, 6}, {0, 6}, {0, 0}, {8, 0}},
                        {.turn_rad_per_scan = turn_rad_per_scan});
}

TEST(ScanOdometry, StampsThatComeInBurstsAreNoSpeed) {
  auto drive = scanned_round_a_room(0.12);
  come_in_bursts(drive.log, 3, LogTime(0.01));
  EXPECT_LT(scan_odometry_error_m(drive), 0.2);
}

TEST(ScanOdometry, FollowsQuickTurnsWhoseStampsComeInBursts) {
  auto drive = scanned_round_a_room(0.35);
  come_in_bursts(drive.log, 4, LogTime(0.001));
  EXPECT_LT(scan_odometry_error_m(drive), 0.2);
}

}  // namespace
}  // namespace lapwing::slam
