#include "slam/scan/deskew.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "slam/mapper.hpp"
#include "slam/testing/simulated_drive.hpp"

namespace lapwing::slam {
namespace {

constexpr float nothing_m = 12.0F;

Sensor turning_laser(int beams, double first, double span) {
  Sensor sensor;
  sensor.no_return_m = nothing_m;
  sensor.mount_m = {0.1F, -0.05F};
  for (int i = 0; i < beams; ++i) sensor.bearings_rad.push_back(static_cast<float>(first + span * i / beams));
  return sensor;
}

/// Ends in a frame that stands.
Eigen::Vector2d end_of(Pose2 const& robot, Sensor const& sensor, double bearing, double range_m) {
  auto const end = robot * Pose2{sensor.mount_m.x() + range_m * std::cos(bearing),
                                 sensor.mount_m.y() + range_m * std::sin(bearing), 0.0};
  return place(end);
}

/// Ahead and to the left while it looks around once.
struct Motion {
  Pose2 at(double share) const { return Pose2{1.0, 2.0, 0.4} * Pose2{0.1 * share, 0.01 * share, 0.2 * share}; }
};

TEST(Deskew, LeavesTheEndOfEachBeamWhereItWas) {
  auto const sensor = turning_laser(360, -std::numbers::pi, 2.0 * std::numbers::pi);
  Motion const motion;
  auto const pose_of = [&](std::size_t beam) { return motion.at(static_cast<double>(beam) / 359.0); };
  Scan scan{.time = LogTime(7.0), .odometry = motion.at(0.5), .ranges_m = {}};
  std::vector<Eigen::Vector2d> ends;
  for (std::size_t beam = 0; beam < 360; ++beam) {
    scan.ranges_m.push_back(2.0F + 0.01F * static_cast<float>(beam % 7));
    ends.push_back(end_of(pose_of(beam), sensor, sensor.bearings_rad[beam], scan.ranges_m.back()));
  }
  auto const seen = deskewed(scan, sensor, pose_of);
  EXPECT_EQ(seen.time, scan.time);
  EXPECT_EQ(seen.odometry, scan.odometry);
  ASSERT_EQ(seen.ranges_m.size(), ends.size());
  EXPECT_TRUE(std::ranges::is_sorted(bearings_of(seen, sensor)));
  for (auto const& end : ends) {
    auto least_m = 1.0;
    for (std::size_t i = 0; i < ends.size(); ++i) {
      auto const at = end_of(seen.odometry, sensor, bearings_of(seen, sensor)[i], seen.ranges_m[i]);
      least_m = std::min(least_m, (at - end).norm());
    }
    EXPECT_LT(least_m, 1e-5);
  }
}

TEST(Deskew, ChangesNothingWhileTheRobotStands) {
  auto const sensor = turning_laser(181, -0.5 * std::numbers::pi, std::numbers::pi);
  Scan const scan{.odometry = {1.0, 2.0, 0.4}, .ranges_m = std::vector<float>(181, 3.0F)};
  auto const seen = deskewed(scan, sensor, [&](std::size_t) { return scan.odometry; });
  for (std::size_t i = 0; i < 181; ++i) {
    EXPECT_NEAR(bearings_of(seen, sensor)[i], sensor.bearings_rad[i], 1e-6);
    EXPECT_NEAR(seen.ranges_m[i], 3.0F, 1e-6);
  }
}

TEST(Deskew, LeavesWhatSawNothingAndWhatItWouldNotSeeWithoutARange) {
  auto const sensor = turning_laser(181, -0.5 * std::numbers::pi, std::numbers::pi);
  Scan scan{.odometry = {}, .ranges_m = std::vector<float>(181, 3.0F)};
  scan.ranges_m[60] = nothing_m;
  scan.ranges_m[70] = std::numeric_limits<float>::quiet_NaN();
  scan.ranges_m[80] = 0.0F;
  // It has turned to the left by 0.1 rad when the last beam is taken: what that saw lies out of its sight at first.
  auto const seen =
      deskewed(scan, sensor, [](std::size_t beam) { return Pose2{0.0, 0.0, 0.1 * static_cast<double>(beam) / 180.0}; });
  auto const has_range = [](float range) { return range > 0.0F && range < nothing_m; };
  EXPECT_NEAR(static_cast<double>(std::ranges::count_if(seen.ranges_m, has_range)), 181 - 3 - 6, 1.0);
  EXPECT_LE(bearings_of(seen, sensor).back(), sensor.bearings_rad.back() + 0.01F);
  EXPECT_TRUE(std::ranges::is_sorted(bearings_of(seen, sensor)));
}

/// Each scan as the place where it ended would have seen it.
ScanLog deskewed(ScanLog log) {
  auto const raw = log.scans;
  auto const& sensor = log.sensors.front();
  for (std::size_t i = 1; i < raw.size(); ++i) {
    auto const moved = between(raw[i - 1].odometry, raw[i].odometry);
    auto const beams = static_cast<double>(raw[i].ranges_m.size());
    log.scans[i] = slam::deskewed(raw[i], sensor, [&](std::size_t beam) {
      auto const share = static_cast<double>(beam + 1) / beams;
      return raw[i - 1].odometry * Pose2{share * moved.x, share * moved.y, share * moved.yaw};
    });
  }
  return log;
}

// As small robots have them: five turns a second, and a robot that turns on the spot by a radian a second.
TEST(Deskew, MakesTheMapOfASlowScannerAsGoodAsThatOfAFastOne) {
  auto const turning = slam::testing::drive(slam::testing::office(24.0, 14.0, 4.0, 1.0, 3),
                                            {{0, 0}, {24, 0}, {24, 14}, {0, 14}, {0, 0}, {24, 0}},
                                            {.beams = 360,
                                             .field_of_view_rad = 2.0 * std::numbers::pi,
                                             .most_range_m = 8.0,
                                             .turn_rad_per_scan = 0.2,
                                             .turns_while_driving = true});
  auto const error_m = [&](ScanLog const& log) {
    auto const mapping = map_log(log, {}, one_by_one, [](std::string_view, double) {});
    return slam::testing::greatest_error_m(mapping.trajectory, turning.truth);
  };
  // 0.014 m, as where all beams are taken at once, and 0.058 m.
  EXPECT_LT(error_m(deskewed(turning.log)), 0.5 * error_m(turning.log));
}

}  // namespace
}  // namespace lapwing::slam
