// A scanner turns while its robot does: what it saw is laid where it was.
#include "robot/ranges/scan_laying.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "robot/sensors/testing/simulated_drive.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

firmware::Description description(float step_sign = 1.0F) {
  firmware::Description body;
  body.wheel_base_m = 0.28F;
  body.pulses_per_m = 9'400.0F;
  body.top_speed_m_s = 0.3F;
  body.braking_m_s2 = 1.0F;
  body.laser = {.beams = 360,
                .first_angle_rad = -step_sign * std::numbers::pi_v<float>,
                .step_rad = step_sign * 2.0F * std::numbers::pi_v<float> / 360.0F,
                .longest_m = 8.0F,
                .scan_duration_s = 0.2F};
  return body;
}

/// Drives or turns; after it the last seconds of where it looked are known.
struct Moving {
  explicit Moving(firmware::Description const& of) : body(of), odometry(of) {}
  void turn(double rad_s, int steps) { move(0.0, rad_s, steps); }
  void move(double speed_m_s, double rad_s, int steps) {
    for (int i = 0; i < steps; ++i) {
      auto const readings = drive.step(speed_m_s, rad_s);
      now = readings.time;
      (void)odometry.feed(readings);
    }
  }
  /// `range(from, yaw)`: of a beam from there that looks that way, in the odometry frame.
  template <class Range>
  [[nodiscard]] LaserRanges scan(firmware::Time begin, Range const& range) const {
    LaserRanges scan{.time = begin,
                     .first_angle_rad = body.laser.first_angle_rad,
                     .step_rad = body.laser.step_rad,
                     .ranges_m = std::vector<double>(body.laser.beams, 0.0)};
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      auto const share = static_cast<double>(beam) / (body.laser.beams - 1);
      auto const from = odometry.at(begin + firmware::Time(std::llround(share * 200'000.0)));
      auto const yaw = from.yaw + scan.first_angle_rad + scan.step_rad * static_cast<double>(beam);
      scan.ranges_m[beam] = range(from, yaw);
    }
    return scan;
  }
  /// A post two metres away at `world_rad`, and nothing else within reach.
  [[nodiscard]] LaserRanges scan_of_post(firmware::Time begin, double world_rad) const {
    return scan(begin, [&](slam::Pose2 const& /*from*/, double yaw) {
      return std::abs(geo::wrap_pi(yaw - world_rad)) < 0.03 ? 2.0 : 0.0;
    });
  }
  /// Walls on both sides, along x.
  [[nodiscard]] LaserRanges scan_of_corridor(firmware::Time begin, double left_m, double right_m) const {
    return scan(begin, [&](slam::Pose2 const& from, double yaw) {
      double const range_m = ((std::sin(yaw) > 0.0 ? left_m : -right_m) - from.y) / std::sin(yaw);
      return range_m < 7.9 ? range_m : 0.0;
    });
  }
  firmware::Description body;
  testing::SimulatedDrive drive{body,
                                1,
                                {.wheel_scale = 0,
                                 .wheel_slip = 0,
                                 .rate_noise_rad_s = 0,
                                 .rate_bias_rad_s = 0,
                                 .rate_bias_walk = 0,
                                 .force_noise_m_s2 = 0,
                                 .force_bias_m_s2 = 0,
                                 .tilt_rad = 0}};
  BoardOdometry odometry;
  firmware::Time now{};
};

/// The middle of the beams that see the post, in the robot's frame.
double bearing_of_post(slam::Scan const& scan, slam::Sensor const& sensor) {
  auto const& bearings = bearings_of(scan, sensor);
  double x = 0.0;
  double y = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] > 3.0F) continue;
    x += std::cos(bearings[i]);
    y += std::sin(bearings[i]);
  }
  return std::atan2(y, x);
}

TEST(ScanLaying, PutsBeamsWhereTheMiddleOfTheScanWouldHaveSeenThem) {
  for (float const sign : {1.0F, -1.0F}) {
    Moving robot(description(sign));
    robot.turn(0.0, 30);
    robot.turn(0.8, 20);
    auto const begin = robot.now - 400ms;
    auto const middle = robot.odometry.at(begin + 100ms);
    // Seen by the last beams of the scan, when the robot has turned by 0.08 rad since its middle.
    double const post_rad = middle.yaw + (sign > 0.0F ? 2.7 : -2.7);
    auto const scan = robot.scan_of_post(begin, post_rad);
    auto const sensor = sensor_of(robot.body.laser);
    auto const laid = lay(scan, robot.body.laser, sensor, robot.odometry);
    EXPECT_EQ(laid.odometry, middle);
    EXPECT_NEAR(geo::wrap_pi(bearing_of_post(laid, sensor) - (post_rad - middle.yaw)), 0.0, 0.02);
    EXPECT_TRUE(std::ranges::is_sorted(bearings_of(laid, sensor)));
  }
}

// A beam that looks aside while the robot drives on has its end half a beam's step away from where it would be seen in
// the middle of the scan. Held to the sensor's own directions, both walls of a corridor are turned by some 0.004 rad,
// and a map of 48 m of it is bent by 0.1 m.
TEST(ScanLaying, LeavesWallsStraightThatTheRobotDrivesAlong) {
  for (float const sign : {1.0F, -1.0F}) {
    Moving robot(description(sign));
    robot.move(0.0, 0.0, 30);
    robot.move(0.3, 0.0, 30);
    auto const sensor = sensor_of(robot.body.laser);
    auto const scan = robot.scan_of_corridor(robot.now - 400ms, 1.2, 1.8);
    auto const laid = lay(scan, robot.body.laser, sensor, robot.odometry);
    auto const& bearings = bearings_of(laid, sensor);
    ASSERT_EQ(laid.ranges_m.size(), bearings.size());
    int seen = 0;
    for (std::size_t i = 0; i < bearings.size(); ++i) {
      if (laid.ranges_m[i] >= sensor.no_return_m) continue;
      auto const end_y = laid.odometry.y + laid.ranges_m[i] * std::sin(laid.odometry.yaw + bearings[i]);
      EXPECT_NEAR(end_y, end_y > 0.0 ? 1.2 : -1.8, 1e-3) << bearings[i];
      ++seen;
    }
    EXPECT_GT(seen, 300);
  }
}

TEST(BoardOdometry, GoesOnWhereItWasWhenTheBoardHasStartedAnew) {
  Moving robot(description());
  robot.turn(0.0, 30);
  robot.turn(0.8, 10);
  auto const before = robot.odometry.pose();
  ASSERT_GT(before.yaw, 0.3);
  BoardOdometry anew(robot.body, before);
  EXPECT_EQ(anew.pose(), before);
  testing::SimulatedDrive started(robot.body, 2);
  for (int i = 0; i < 5; ++i) (void)anew.feed(started.step(0.0, 0.0));
  EXPECT_NEAR(anew.pose().yaw, before.yaw, 0.02);
}

TEST(ScanLaying, KnowsWhenAScanWasAtItsEnd) {
  auto const body = description();
  EXPECT_EQ(end_of({.time = 1s, .first_angle_rad = 0.0, .step_rad = 0.0, .ranges_m = {}}, body.laser), 1200ms);
}

TEST(ScanLaying, LeavesWhatSawNothingWithoutARange) {
  Moving robot(description());
  robot.turn(0.0, 5);
  LaserRanges const nothing{.time = robot.now - 300ms,
                            .first_angle_rad = -std::numbers::pi,
                            .step_rad = 2.0 * std::numbers::pi / 360.0,
                            .ranges_m = std::vector<double>(360, 0.0)};
  auto const sensor = sensor_of(robot.body.laser);
  for (auto const range : lay(nothing, robot.body.laser, sensor, robot.odometry).ranges_m)
    EXPECT_EQ(range, sensor.no_return_m);
}

}  // namespace
}  // namespace lapwing::robot
