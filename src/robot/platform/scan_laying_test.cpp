// A scanner turns while its robot does: what it saw is laid where it was.
#include "robot/platform/scan_laying.hpp"

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

/// Turns on the spot; after it the last seconds of where it looked are known.
struct Turning {
  explicit Turning(firmware::Description const& of) : body(of), odometry(of) {}
  void turn(double rad_s, int steps) {
    for (int i = 0; i < steps; ++i) {
      auto const readings = drive.step(0.0, rad_s);
      now = readings.time;
      (void)odometry.feed(readings);
    }
  }
  /// A post two metres away at `world_rad` of the odometry frame, and nothing else within reach.
  [[nodiscard]] LaserRanges scan_of_post(firmware::Time begin, double world_rad) const {
    LaserRanges scan{.time = begin,
                     .first_angle_rad = body.laser.first_angle_rad,
                     .step_rad = body.laser.step_rad,
                     .ranges_m = std::vector<double>(body.laser.beams, 0.0)};
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      auto const share = static_cast<double>(beam) / (body.laser.beams - 1);
      auto const at = begin + firmware::Time(std::llround(share * 200'000.0));
      double const looks = odometry.at(at).yaw + scan.first_angle_rad + scan.step_rad * static_cast<double>(beam);
      if (std::abs(geo::wrap_pi(looks - world_rad)) < 0.03) scan.ranges_m[beam] = 2.0;
    }
    return scan;
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
  double x = 0.0;
  double y = 0.0;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (scan.ranges_m[i] > 3.0F) continue;
    x += std::cos(sensor.bearings_rad[i]);
    y += std::sin(sensor.bearings_rad[i]);
  }
  return std::atan2(y, x);
}

TEST(ScanLaying, PutsBeamsWhereTheMiddleOfTheScanWouldHaveSeenThem) {
  for (float const sign : {1.0F, -1.0F}) {
    Turning robot(description(sign));
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
    EXPECT_TRUE(std::ranges::is_sorted(sensor.bearings_rad));
  }
}

TEST(BoardOdometry, GoesOnWhereItWasWhenTheBoardHasStartedAnew) {
  Turning robot(description());
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
  Turning robot(description());
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
