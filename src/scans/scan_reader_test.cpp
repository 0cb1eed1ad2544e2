#include "scans/scan_reader.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::scans {
namespace {

constexpr float quarter = std::numbers::pi_v<float> / 2.0F;

bus::LaserScan a_scan(std::vector<float> ranges) {
  return {.angle_min = -quarter,
          .angle_increment = quarter,
          .range_min = 0.1F,
          .range_max = 12.0F,
          .ranges = std::move(ranges)};
}

TEST(ScanReader, KnowsWhereTheBeamsLook) {
  auto const reader = ScanReader::make(a_scan({1.0F, 2.0F, 3.0F}), {.pose = {0.2, 0.1, 0.0}});
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->sensor().bearings_rad, (std::vector<float>{-quarter, 0.0F, quarter}));
  EXPECT_EQ(reader->sensor().mount_m, Eigen::Vector2f(0.2F, 0.1F));
}

TEST(ScanReader, TurnsRoundWhatHangsUpsideDown) {
  auto const reader = ScanReader::make(a_scan({1.0F, 2.0F, 3.0F}), {.pose = {}, .is_upside_down = true});
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->sensor().bearings_rad, (std::vector<float>{-quarter, 0.0F, quarter})) << "ascending all the same";
  EXPECT_EQ(*reader->ranges(a_scan({1.0F, 2.0F, 3.0F})), (std::vector<float>{3.0F, 2.0F, 1.0F}));
}

TEST(ScanReader, TakesWhatIsNoRangeForNothingMeasured) {
  auto const reader = ScanReader::make(a_scan({1.0F, 2.0F, 3.0F}), {});
  auto const infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(*reader->ranges(a_scan({std::nanf(""), 0.05F, infinity})), (std::vector<float>{0.0F, 0.0F, 12.0F}));
  EXPECT_FALSE(reader->ranges(a_scan({1.0F}))) << "another laser's";
}

/// Of a wall 2 m ahead and square to it, by a scanner that gives so many beams over three quarters of a circle.
bus::LaserScan of_a_wall(int beams, double begins_rad = -0.75 * std::numbers::pi) {
  double const step_rad = 1.5 * std::numbers::pi / beams;
  bus::LaserScan scan{.angle_min = static_cast<float>(begins_rad),
                      .angle_increment = static_cast<float>(step_rad),
                      .range_min = 0.1F,
                      .range_max = 8.0F,
                      .ranges = {}};
  for (int i = 0; i < beams; ++i) {
    double const angle = begins_rad + i * step_rad;
    bool const meets_it = std::abs(angle) < 1.2;
    scan.ranges.push_back(meets_it ? static_cast<float>(2.0 / std::cos(angle)) : std::nanf(""));
  }
  return scan;
}

// As an LDS-02 does, whose motor is not regulated, and an RPLIDAR whose driver does not compensate angles.
TEST(ScanReader, LaysScansOfMoreOrFewerBeamsOnThoseOfTheFirst) {
  auto const reader = ScanReader::make(of_a_wall(270), {});
  ASSERT_TRUE(reader);
  auto const& bearings = reader->sensor().bearings_rad;
  for (int const beams : {230, 269, 270, 271, 300}) {
    auto const scan = of_a_wall(beams, -0.75 * std::numbers::pi + 0.01);
    ASSERT_TRUE(reader->fits(scan)) << beams;
    auto const ranges = reader->ranges(scan);
    ASSERT_TRUE(ranges);
    ASSERT_EQ(ranges->size(), 270U);
    int measured = 0;
    for (std::size_t i = 0; i < ranges->size(); ++i) {
      if ((*ranges)[i] == 0.0F) continue;
      ++measured;
      if (std::abs(bearings[i]) > 1.18F) continue;  // the wall ends there: it has one neighbour
      EXPECT_NEAR((*ranges)[i] * std::cos(bearings[i]), 2.0, 0.01) << beams << " beams, " << bearings[i];
    }
    EXPECT_NEAR(measured, 2.4 / (1.5 * std::numbers::pi) * 270, 3.0) << beams;
  }
}

TEST(ScanReader, MakesNoSurfaceOfWhatLiesBetweenTwo) {
  auto const reader = ScanReader::make(a_scan({1.0F, 3.0F, 3.0F}), {});
  auto scan = a_scan({1.0F, 3.0F, 3.0F, 5.0F});
  scan.angle_min -= 0.05F;
  scan.angle_increment *= 0.75F;
  auto const ranges = reader->ranges(scan);
  ASSERT_TRUE(ranges);
  for (float const range : *ranges) EXPECT_TRUE(range == 1.0F || range == 3.0F || range == 5.0F) << range;
}

TEST(ScanReader, SpreadsTheTimeOfATurnOverTheFirstOnesBeams) {
  using namespace std::chrono_literals;
  auto const reader = ScanReader::make(of_a_wall(270), {});
  auto scan = of_a_wall(300);
  scan.time_increment = 0.2F / 300.0F;
  auto const times = reader->times(scan, 5s);
  EXPECT_EQ(times.beams, 270U);
  EXPECT_NEAR(std::chrono::duration<double>(times.end()).count(), 5.2, 0.002);
}

TEST(ScanReader, TakesAScanOfOtherAnglesForAnotherLasers) {
  auto const reader = ScanReader::make(of_a_wall(270), {});
  EXPECT_FALSE(reader->fits(of_a_wall(100)));
  EXPECT_FALSE(reader->fits(of_a_wall(600)));
  EXPECT_FALSE(reader->fits(of_a_wall(270, -2.0)));
  auto scan = of_a_wall(270);
  scan.angle_increment = -scan.angle_increment;
  EXPECT_FALSE(reader->fits(scan));
  scan.angle_increment = std::nanf("");
  EXPECT_FALSE(reader->fits(scan));
  EXPECT_FALSE(reader->ranges(scan));
}

TEST(ScanReader, KnowsWhenEachBeamWasTaken) {
  using namespace std::chrono_literals;
  auto scan = a_scan({1.0F, 2.0F, 3.0F});
  scan.time_increment = 0.01F;
  auto const times = ScanReader::make(scan, {})->times(scan, 5s);
  EXPECT_EQ(times.at(2), 5020ms);
  EXPECT_EQ(times.middle(), 5010ms);
  auto const upside_down = ScanReader::make(scan, {.pose = {}, .is_upside_down = true})->times(scan, 5s);
  EXPECT_EQ(upside_down.at(0), 5020ms) << "the sensor's first beam is the scan's last";
  EXPECT_EQ(upside_down.at(2), 5s);
  EXPECT_EQ(upside_down.begin(), 5s);
  EXPECT_EQ(upside_down.end(), 5020ms);
  for (float const wrong : {0.0F, -0.01F, 10.0F, std::nanf("")}) {
    scan.time_increment = wrong;
    EXPECT_EQ(ScanReader::make(scan, {})->times(scan, 5s).end(), 5s) << wrong;
  }
}

TEST(LayScan, PutsEachBeamWhereItLookedFrom) {
  using namespace std::chrono_literals;
  slam::Sensor const sensor{.bearings_rad = {-quarter, 0.0F, quarter}};
  BeamTimes const times{.first = 1s, .step = 100ms, .beams = 3};
  // It turns to the left, a tenth of a radian from beam to beam.
  auto const turning = [](std::chrono::nanoseconds time) -> std::optional<slam::Pose2> {
    return slam::Pose2{0.0, 0.0, std::chrono::duration<double>(time).count() - 1.0};
  };
  auto const scan = lay({1.0F, 2.0F, 3.0F}, sensor, times, turning);
  ASSERT_TRUE(scan);
  EXPECT_DOUBLE_EQ(scan->time.count(), 1.1);
  EXPECT_NEAR(scan->odometry.yaw, 0.1, 1e-9);
  EXPECT_NEAR(bearings_of(*scan, sensor)[0], -quarter - 0.1, 1e-5);
  EXPECT_NEAR(bearings_of(*scan, sensor)[1], 0.0, 1e-5);
  EXPECT_NEAR(bearings_of(*scan, sensor)[2], quarter + 0.1, 1e-5);
  EXPECT_EQ(scan->ranges_m, (std::vector<float>{1.0F, 2.0F, 3.0F}));
}

TEST(LayScan, TakesAllBeamsForOnesOfTheMiddleWhereNoMoreIsKnown) {
  using namespace std::chrono_literals;
  slam::Sensor const sensor{.bearings_rad = {-quarter, 0.0F, quarter}};
  BeamTimes const times{.first = 1s, .step = 100ms, .beams = 3};
  auto const until = [](std::chrono::nanoseconds last) {
    return [last](std::chrono::nanoseconds time) {
      auto const yaw = std::chrono::duration<double>(time).count();
      return time <= last ? std::optional(slam::Pose2{1.0, 2.0, yaw}) : std::nullopt;
    };
  };
  auto const scan = lay({1.0F, 2.0F, 3.0F}, sensor, times, until(1150ms));
  ASSERT_TRUE(scan);
  EXPECT_TRUE(scan->bearings_rad.empty());
  EXPECT_FALSE(lay({1.0F, 2.0F, 3.0F}, sensor, times, until(1050ms)));
}

TEST(ScanReader, RefusesWhatNoLaserSends) {
  EXPECT_FALSE(ScanReader::make(a_scan({}), {}));
  auto scan = a_scan({1.0F});
  scan.angle_increment = 0.0F;
  EXPECT_FALSE(ScanReader::make(scan, {}));
  scan.angle_increment = std::nanf("");
  EXPECT_FALSE(ScanReader::make(scan, {}));
  scan = a_scan({1.0F});
  scan.range_max = -1.0F;
  EXPECT_FALSE(ScanReader::make(scan, {}));
}

}  // namespace
}  // namespace lapwing::scans
