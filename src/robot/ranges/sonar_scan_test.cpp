// Sonars as a scan: where their echoes came from, and what silence says.
#include "robot/ranges/sonar_scan.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

constexpr float quarter = std::numbers::pi_v<float> / 2.0F;

/// One looks ahead from the hull's front, one to the left from its left front.
std::vector<firmware::SonarPlace> two_sonars() {
  return {{.x_m = 0.1F, .y_m = 0.1F, .angle_rad = quarter, .half_cone_rad = 0.1F, .longest_m = 5.0F},
          {.x_m = 0.2F, .y_m = 0.0F, .angle_rad = 0.0F, .half_cone_rad = 0.13F, .longest_m = 7.5F}};
}

Sensed sensed(std::optional<double> left_m, std::optional<double> front_m) {
  auto const places = two_sonars();
  Sensed sensed;
  sensed.time = std::chrono::milliseconds(1'500);
  sensed.sonars = {{.place = places[0], .range_m = left_m}, {.place = places[1], .range_m = front_m}};
  sensed.faults.sonars = {SensorFault::none, SensorFault::none};
  return sensed;
}

TEST(SonarScan, SensorIsConesThatReachAsFarAsTheFarthestSonarHears) {
  auto const sensor = sensor_of(two_sonars());
  ASSERT_TRUE(sensor);
  EXPECT_EQ(sensor->bearings_rad, (std::vector<float>{0.0F, quarter})) << "ascending";
  EXPECT_FLOAT_EQ(sensor->half_cone_rad, 0.13F);
  EXPECT_FLOAT_EQ(sensor->no_return_m, 7.7F);
}

TEST(SonarScan, IsNoneOfABodyWithoutSonars) {
  EXPECT_FALSE(sensor_of(std::vector<firmware::SonarPlace>{}));
}

TEST(SonarScan, LaysEachEchoWhereItCameFrom) {
  auto const sensor = sensor_of(two_sonars());
  auto const scan = scan_of(sensed(0.9, 2.0), {1.0, 2.0, 0.5}, *sensor);
  EXPECT_DOUBLE_EQ(scan.time.count(), 1.5);
  EXPECT_EQ(scan.odometry, (slam::Pose2{1.0, 2.0, 0.5}));
  ASSERT_EQ(scan.ranges_m.size(), 2U);
  EXPECT_NEAR(scan.bearings_rad[0], 0.0F, 1e-6);
  EXPECT_NEAR(scan.ranges_m[0], 2.2F, 1e-6);
  EXPECT_NEAR(scan.bearings_rad[1], std::atan2(1.0F, 0.1F), 1e-6) << "it does not look from the axle's middle";
  EXPECT_NEAR(scan.ranges_m[1], std::hypot(1.0F, 0.1F), 1e-6);
}

TEST(SonarScan, TellsSilenceFromASonarThatIsNotBelieved) {
  auto const sensor = sensor_of(two_sonars());
  auto heard = sensed(std::nullopt, std::nullopt);
  heard.faults.sonars[1] = SensorFault::stuck;
  auto const scan = scan_of(heard, {}, *sensor);
  EXPECT_TRUE(std::isnan(scan.ranges_m[0])) << "ahead: stuck";
  EXPECT_GE(scan.ranges_m[1], sensor->no_return_m) << "to the left nothing came back";
}

}  // namespace
}  // namespace lapwing::robot
