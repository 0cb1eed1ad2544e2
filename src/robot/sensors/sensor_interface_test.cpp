#include "robot/sensors/sensor_interface.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "robot/sensors/testing/simulated_drive.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using testing::office_round;
using testing::SimulatedDrive;

double constexpr degree = std::numbers::pi / 180;

firmware::Description body() {
  firmware::Description body{.wheel_base_m = 0.24F,
                             .pulses_per_m = 5'000,
                             .top_speed_m_s = 0.3F,
                             .braking_m_s2 = 0.5F,
                             .hull = {.front_m = 0.15F, .back_m = 0.15F, .half_width_m = 0.14F},
                             .sonar_count = 1,
                             .sonars = {},
                             .laser = {}};
  body.sonars[0] = {.x_m = 0.15F, .y_m = 0, .angle_rad = 0, .half_cone_rad = 0.25F, .longest_m = 7.5F};
  return body;
}

double yaw_error(Sensed const& sensed, SimulatedDrive const& drive) {
  return std::abs(std::remainder(sensed.pose.yaw_rad - drive.truth().yaw_rad, 2 * std::numbers::pi));
}

double place_error(Sensed const& sensed, SimulatedDrive const& drive) {
  return std::hypot(sensed.pose.position.x() - drive.truth().x_m, sensed.pose.position.y() - drive.truth().y_m);
}

TEST(SensorInterface, KeepsYawToADegreeAndPlaceToTwoPercentOfTheWayOverFiveMinutes) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SimulatedDrive drive(body(), seed);
    SensorInterface sensors(body());
    double worst_yaw = 0;
    double worst_place = 0;
    Sensed last;
    office_round(drive, 12, [&](firmware::Readings const& readings) {
      auto const sensed = sensors.feed(readings);
      if (!sensed) return;
      last = *sensed;
      worst_yaw = std::max(worst_yaw, yaw_error(*sensed, drive));
      // The first metres are no way to take a part of.
      if (drive.truth().way_m > 5)
        worst_place = std::max(worst_place, place_error(*sensed, drive) / drive.truth().way_m);
    });
    EXPECT_GT(drive.truth().way_m, 30);
    EXPECT_GT(last.time, 280s);
    EXPECT_LT(worst_yaw, degree) << "seed " << seed;
    EXPECT_LT(worst_place, 0.02) << "seed " << seed;
    EXPECT_NEAR(last.way_m, drive.truth().way_m, 0.02 * drive.truth().way_m) << "seed " << seed;
  }
}

TEST(SensorInterface, SaysHowWrongItMayBe) {
  // Within three standard deviations, of which one run in three hundred may be outside.
  int outside = 0;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SimulatedDrive drive(body(), seed);
    SensorInterface sensors(body());
    Sensed last;
    office_round(drive, 8, [&](firmware::Readings const& readings) {
      if (auto const sensed = sensors.feed(readings)) last = *sensed;
    });
    EXPECT_LT(std::sqrt(last.covariance(2, 2)), 3 * degree);
    if (yaw_error(last, drive) > 3 * std::sqrt(last.covariance(2, 2))) ++outside;
  }
  EXPECT_LE(outside, 1);
}

TEST(SensorInterface, DoesNotMoveThePlaceWhenItLearnsTheBiasAfterALongDrive) {
  // It set off at once, so that the first that is known of the gyroscope is known minutes later.
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SimulatedDrive drive(body(), seed, {.rate_noise_rad_s = 1e-3, .rate_bias_rad_s = 0.002});
    SensorInterface sensors(body());
    Sensed last;
    auto const feed = [&](double speed_m_s, double turn_rad_s) {
      if (auto const sensed = sensors.feed(drive.step(speed_m_s, turn_rad_s))) last = *sensed;
    };
    for (int i = 0; i < 3; ++i) feed(0, 0);
    for (int i = 0; i < 2'000; ++i) feed(0.16, 0.1 * std::sin(i * 0.01));
    for (int i = 0; i < 10; ++i) feed(0, 0);
    auto const stopped = last;
    for (int i = 0; i < 50; ++i) feed(0, 0);
    auto const moved_m = std::hypot(last.pose.position.x() - stopped.pose.position.x(),
                                    last.pose.position.y() - stopped.pose.position.y());
    EXPECT_LT(moved_m, 0.01) << "seed " << seed;
    EXPECT_NEAR(std::remainder(last.pose.yaw_rad - stopped.pose.yaw_rad, 2 * std::numbers::pi), 0, 0.01)
        << "seed " << seed;
  }
}

TEST(SensorInterface, TellsTheSpeedToACentimetreASecond) {
  SimulatedDrive drive(body(), 3, {.wheel_scale = 0});
  SensorInterface sensors(body());
  for (int i = 0; i < 50; ++i) (void)sensors.feed(drive.step(0, 0));
  for (double const speed : {0.16, 0.3, 0.05, -0.16}) {
    for (int i = 0; i < 30; ++i) (void)sensors.feed(drive.step(speed, 0));
    for (int i = 0; i < 20; ++i) {
      auto const sensed = sensors.feed(drive.step(speed, 0.2));
      ASSERT_TRUE(sensed);
      EXPECT_NEAR(sensed->speed_m_s, drive.truth().speed_m_s, 0.01) << speed;
    }
  }
}

TEST(SensorInterface, TellsWheelsThatSpinAndGoesOnByWhatTheBodyFeels) {
  SimulatedDrive drive(body(), 5);
  SensorInterface sensors(body());
  for (int i = 0; i < 50; ++i) (void)sensors.feed(drive.step(0, 0));
  for (int i = 0; i < 50; ++i) (void)sensors.feed(drive.step(0.16, 0));
  drive.spin_m_s = 0.3;
  auto const slipping = sensors.feed(drive.step(0.16, 0));
  ASSERT_TRUE(slipping);
  EXPECT_TRUE(slipping->faults.is_slipping);
  EXPECT_TRUE(slipping->faults.any());
  EXPECT_NEAR(slipping->speed_m_s, 0.16, 0.05);
  (void)sensors.feed(drive.step(0.16, 0));
  drive.spin_m_s = 0;
  for (int i = 0; i < 10; ++i) (void)sensors.feed(drive.step(0.16, 0));
  auto const after = sensors.feed(drive.step(0.16, 0));
  ASSERT_TRUE(after);
  EXPECT_FALSE(after->faults.is_slipping);
  EXPECT_LT(place_error(*after, drive), 0.05);
}

TEST(SensorInterface, GoesOnByTheWheelsWhenTheInertialUnitIsGone) {
  SimulatedDrive drive(body(), 7);
  SensorInterface sensors(body());
  for (int i = 0; i < 50; ++i) (void)sensors.feed(drive.step(0, 0));
  Sensed last;
  for (int i = 0; i < 100; ++i) {
    auto readings = drive.step(0.16, 0.1);
    if (i > 20) readings.imu.reset();
    if (auto const sensed = sensors.feed(readings)) last = *sensed;
  }
  EXPECT_EQ(last.faults.imu, SensorFault::dropouts);
  EXPECT_LT(place_error(last, drive), 0.1);
  EXPECT_LT(yaw_error(last, drive), 8 * degree);
  EXPECT_GT(last.covariance(2, 2), std::pow(0.5 * degree, 2));
}

TEST(SensorInterface, DoesNotBelieveACounterThatJumps) {
  SimulatedDrive drive(body(), 9);
  SensorInterface sensors(body());
  for (int i = 0; i < 50; ++i) (void)sensors.feed(drive.step(0, 0));
  for (int i = 0; i < 20; ++i) (void)sensors.feed(drive.step(0.16, 0));
  auto const shifted = [](firmware::Readings readings) {
    readings.left_pulses += 1'000'000;
    return readings;
  };
  auto const jumped = sensors.feed(shifted(drive.step(0.16, 0)));
  ASSERT_TRUE(jumped);
  EXPECT_EQ(jumped->faults.encoders, SensorFault::jumping);
  for (int i = 0; i < 20; ++i) (void)sensors.feed(shifted(drive.step(0.16, 0)));
  auto const after = sensors.feed(shifted(drive.step(0.16, 0)));
  ASSERT_TRUE(after);
  EXPECT_EQ(after->faults.encoders, SensorFault::none);
  EXPECT_LT(place_error(*after, drive), 0.05);
}

TEST(SensorInterface, TakesNoReadingsTwiceAndNoneFromThePast) {
  SimulatedDrive drive(body(), 1);
  SensorInterface sensors(body());
  EXPECT_FALSE(sensors.feed(drive.step(0, 0)));
  auto const readings = drive.step(0, 0);
  EXPECT_TRUE(sensors.feed(readings));
  EXPECT_FALSE(sensors.feed(readings));
  auto old = readings;
  old.time -= 50ms;
  EXPECT_FALSE(sensors.feed(old));
}

TEST(SensorInterface, TellsTheSameAgainFromTheSameReadings) {
  auto const run = [] {
    SimulatedDrive drive(body(), 4);
    SensorInterface sensors(body());
    std::vector<double> places;
    office_round(drive, 2, [&](firmware::Readings const& readings) {
      if (auto const sensed = sensors.feed(readings)) places.push_back(sensed->pose.position.x());
    });
    return places;
  };
  EXPECT_EQ(run(), run());
}

TEST(WheelOdometer, GoesOnWhereTheCounterWraps) {
  WheelOdometer odometer(body());
  firmware::Readings readings;
  readings.left_pulses = 2'147'483'600;
  readings.right_pulses = -2'147'483'600;
  EXPECT_FALSE(odometer.feed(readings));
  readings.time += 100ms;
  readings.left_pulses = -2'147'483'596;  // 100 further
  readings.right_pulses = 2'147'483'596;  // 100 back
  auto const step = odometer.feed(readings);
  ASSERT_TRUE(step);
  EXPECT_FALSE(step->has_jumped);
  EXPECT_DOUBLE_EQ(step->wheels.left_m, 0.02);
  EXPECT_DOUBLE_EQ(step->wheels.right_m, -0.02);
  EXPECT_NEAR(step->wheels.turn_rad(), -0.04 / 0.24, 1e-6);
}

}  // namespace
}  // namespace lapwing::robot
