#include "robot/sensors/sonar.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "robot/sensors/imu_watch.hpp"
#include "robot/sensors/sonar_watch.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
double constexpr degree = std::numbers::pi / 180;
firmware::Hull constexpr hull{.front_m = 0.15F, .back_m = 0.15F, .half_width_m = 0.14F};

firmware::SonarPlace at(double x_m, double y_m, double angle_deg) {
  return {.x_m = static_cast<float>(x_m),
          .y_m = static_cast<float>(y_m),
          .angle_rad = static_cast<float>(angle_deg * degree),
          .half_cone_rad = 0.25F,
          .longest_m = 5};
}

/// Ahead, slanted to the left and the right, square to the left and the right.
std::vector<firmware::SonarPlace> five() {
  return {at(0.15, 0, 0), at(0.12, 0.08, 30), at(0.12, -0.08, -30), at(0, 0.14, 90), at(0, -0.14, -90)};
}

/// What each hears of an endless wall: the line of points p with n·p = distance, n at `normal_deg`.
std::vector<SonarReading> beside_wall(double distance_m, double normal_deg) {
  std::vector<SonarReading> sonars;
  double const nx = std::cos(normal_deg * degree);
  double const ny = std::sin(normal_deg * degree);
  for (auto const& place : five()) {
    double const angle = static_cast<double>(place.angle_rad);
    double const approach = nx * std::cos(angle) + ny * std::sin(angle);
    double const gap = distance_m - nx * static_cast<double>(place.x_m) - ny * static_cast<double>(place.y_m);
    bool const is_heard = approach > 0.3 && gap / approach < 5;
    sonars.push_back({.place = place, .range_m = is_heard ? std::optional(gap / approach) : std::nullopt});
  }
  return sonars;
}

TEST(Sonar, CountsMicrosecondsAnInch) {
  EXPECT_NEAR(range_of_echo(147, at(0, 0, 0)).value(), 0.0254, 1e-6);
  EXPECT_NEAR(range_of_echo(14'700, at(0, 0, 0)).value(), 2.54, 1e-5);
  EXPECT_FALSE(range_of_echo(firmware::no_echo_us, at(0, 0, 0)));
  EXPECT_FALSE(range_of_echo(30'000, at(0, 0, 0)));  // 5.18 m
}

TEST(WallDistances, AreThePerpendicularsOfWallsThatBothSonarsOfASideHear) {
  // Negative: the wall comes nearer ahead.
  for (double const turned : {-30.0, -10.0, 0.0, 10.0}) {
    auto const left = wall_distances(beside_wall(1.2, 90 + turned), hull);
    ASSERT_TRUE(left.left_m) << turned;
    EXPECT_NEAR(*left.left_m, 1.2, 0.02) << turned;
    auto const right = wall_distances(beside_wall(0.8, -90 - turned), hull);
    ASSERT_TRUE(right.right_m) << turned;
    EXPECT_NEAR(*right.right_m, 0.8, 0.02) << turned;
    EXPECT_FALSE(right.left_m && *right.left_m < 0.8) << turned;
  }
}

TEST(WallDistances, OneEchoIsAWallBesideTheBody) {
  auto sonars = beside_wall(1.2, 90);
  sonars[1].range_m.reset();
  EXPECT_NEAR(wall_distances(sonars, hull).left_m.value(), 1.2, 1e-6);
  sonars = beside_wall(1.2, 90);
  sonars[3].range_m.reset();
  EXPECT_NEAR(wall_distances(sonars, hull).left_m.value(), 1.2, 1e-6);
}

TEST(WallDistances, AheadIsTheNearestInTheWay) {
  auto const ahead = wall_distances(beside_wall(2.0, 0), hull);
  ASSERT_TRUE(ahead.front_m);
  EXPECT_NEAR(*ahead.front_m, 2.0, 1e-6);
  // A post that only the slanted sonar hears, within the hull's width.
  std::vector<SonarReading> sonars;
  for (auto const& place : five()) sonars.push_back({.place = place, .range_m = std::nullopt});
  sonars[1].range_m = 0.1;
  auto const post = wall_distances(sonars, hull);
  ASSERT_TRUE(post.front_m);
  EXPECT_NEAR(*post.front_m, 0.12 + 0.1 * std::cos(30 * degree), 1e-6);
}

TEST(WallDistances, AreNoneWhereNothingIsHeard) {
  std::vector<SonarReading> sonars;
  for (auto const& place : five()) sonars.push_back({.place = place, .range_m = std::nullopt});
  auto const walls = wall_distances(sonars, hull);
  EXPECT_FALSE(walls.left_m || walls.front_m || walls.right_m);
}

// ---- faults ----

std::uint16_t echo(double range_m) {
  return static_cast<std::uint16_t>(std::lround(range_m * static_cast<double>(firmware::echo_us_per_m)));
}

TEST(SonarWatch, TellsAStuckSonarByTheBodysTurningOrItsWay) {
  SonarWatch ahead(at(0.15, 0, 0));
  SensorFault fault{};
  for (int i = 0; i < 40; ++i) fault = ahead.feed(echo(1.0), {.way_m = i * 0.016, .turn_rad = 0});
  EXPECT_EQ(fault, SensorFault::stuck);
  EXPECT_EQ(ahead.feed(echo(0.9), {.way_m = 1, .turn_rad = 0}), SensorFault::none);
  SonarWatch beside(at(0, 0.14, 90));
  for (int i = 0; i < 10; ++i) fault = beside.feed(echo(1.0), {.way_m = 0, .turn_rad = i * 0.08});
  EXPECT_EQ(fault, SensorFault::stuck);
}

TEST(SonarWatch, ACorridorsWallMayStayWhereItIs) {
  SonarWatch beside(at(0, 0.14, 90));
  for (int i = 0; i < 200; ++i)
    EXPECT_EQ(beside.feed(echo(1.0), {.way_m = i * 0.03, .turn_rad = 0}), SensorFault::none);
  SonarWatch ahead(at(0.15, 0, 0));
  for (int i = 0; i < 200; ++i) EXPECT_EQ(ahead.feed(echo(1.0), {.way_m = 0, .turn_rad = 0}), SensorFault::none);
  for (int i = 0; i < 200; ++i)
    EXPECT_EQ(ahead.feed(firmware::no_echo_us, {.way_m = i * 0.03, .turn_rad = 0}), SensorFault::none);
}

TEST(SonarWatch, TellsOneThatJumpsAndLetsDoorsPass) {
  SonarWatch jumping(at(0, 0.14, 90));
  SensorFault fault{};
  for (int i = 0; i < 12; ++i) fault = jumping.feed(echo(i % 2 == 0 ? 1.0 : 3.0), {.way_m = i * 0.01, .turn_rad = 0});
  EXPECT_EQ(fault, SensorFault::jumping);
  SonarWatch passing(at(0, 0.14, 90));
  for (int i = 0; i < 100; ++i) {
    double const range = i % 25 < 18 ? 1.0 + 0.001 * (i % 7) : 3.0;
    EXPECT_EQ(passing.feed(echo(range), {.way_m = i * 0.016, .turn_rad = 0}), SensorFault::none) << i;
  }
}

TEST(SonarWatch, TellsOneThatHearsANearThingNowAndThen) {
  SonarWatch watch(at(0, 0.14, 90));
  SensorFault fault{};
  for (int i = 0; i < 30; ++i)
    fault =
        watch.feed(i % 3 == 0 ? echo(1.0 + 0.01 * (i % 5)) : firmware::no_echo_us, {.way_m = i * 0.016, .turn_rad = 0});
  EXPECT_EQ(fault, SensorFault::dropouts);
}

firmware::Readings felt(int step, double rate, double yaw) {
  firmware::Readings readings;
  readings.time = step * 100ms;
  readings.imu =
      firmware::Imu{.orientation = {.w = static_cast<float>(std::cos(yaw / 2)),
                                    .x = 0,
                                    .y = 0,
                                    .z = static_cast<float>(std::sin(yaw / 2))},
                    .rate_rad_s = {.x = 0.0001F * static_cast<float>(step), .y = 0, .z = static_cast<float>(rate)},
                    .acceleration_m_s2 = {.x = 0, .y = 0, .z = 9.8F}};
  return readings;
}

TEST(ImuWatch, TellsSilenceAfterThreeReadings) {
  ImuWatch watch;
  firmware::Readings const silent;
  EXPECT_EQ(watch.feed(silent), SensorFault::none);
  EXPECT_EQ(watch.feed(silent), SensorFault::none);
  EXPECT_EQ(watch.feed(silent), SensorFault::dropouts);
  EXPECT_EQ(watch.feed(felt(1, 0, 0)), SensorFault::none);
}

TEST(ImuWatch, TellsOneThatIsStuckAndOneWhoseOrientationJumps) {
  ImuWatch watch;
  SensorFault fault{};
  for (int i = 0; i < 12; ++i) {
    auto readings = felt(1, 0, 0);
    readings.time = i * 100ms;
    fault = watch.feed(readings);
  }
  EXPECT_EQ(fault, SensorFault::stuck);
  ImuWatch jumping;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(jumping.feed(felt(i, 0.5, i * 0.05)), SensorFault::none);
  EXPECT_EQ(jumping.feed(felt(10, 0.5, 2.0)), SensorFault::jumping);
  EXPECT_EQ(jumping.feed(felt(11, 0.5, 2.05)), SensorFault::none);
  EXPECT_EQ(jumping.feed(felt(12, 30, 2.1)), SensorFault::jumping);
}

}  // namespace
}  // namespace lapwing::robot
