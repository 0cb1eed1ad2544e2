#include "robot/rover/rover_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot::rover {
namespace {

using namespace std::chrono_literals;
using mavlink::DistanceSensor;
using mavlink::MavFrame;
using mavlink::ObstacleDistance;

constexpr double degree = std::numbers::pi / 180.0;
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

ObstacleDistance four_sides() {
  return {.distances_m = {1.0F, 2.0F, 3.0F, 4.0F},
          .step_rad = 90.0 * degree,
          .least_m = 0.2,
          .most_m = 8.0,
          .first_bearing_rad = 0.0,
          .frame = MavFrame::body_frd};
}

TEST(RoverRanges, CountClockwiseFromAheadAsObstacleDistanceDoes) {
  RoverRanges ranges;
  auto const scan = ranges.take(four_sides());
  ASSERT_TRUE(scan);
  ASSERT_NE(ranges.sensor(), nullptr);
  auto const& bearings = ranges.sensor()->bearings_rad;
  ASSERT_EQ(bearings.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(bearings));
  EXPECT_FLOAT_EQ(ranges.sensor()->no_return_m, 8.0F);
  auto const at = [&](double degrees) {
    auto const looks_there = [&](float bearing) { return std::abs(bearing - degrees * degree) < 0.01; };
    return (*scan)[static_cast<std::size_t>(std::ranges::find_if(bearings, looks_there) - bearings.begin())];
  };
  EXPECT_FLOAT_EQ(at(0.0), 1.0F) << "ahead";
  EXPECT_FLOAT_EQ(at(-90.0), 2.0F) << "to the right";
  EXPECT_FLOAT_EQ(at(90.0), 4.0F) << "to the left";
}

TEST(RoverRanges, TellWhatIsNotMeasuredFromWhatIsClear) {
  RoverRanges ranges;
  auto seen = four_sides();
  seen.distances_m = {unknown, 8.01F, 0.1F};
  auto const scan = ranges.take(seen).value();
  EXPECT_EQ(std::ranges::count(scan, 0.0F), 3) << "unknown, nearer than it can measure, and not told";
  EXPECT_EQ(std::ranges::count(scan, 8.0F), 1) << "nothing is there";
}

TEST(RoverRanges, GoByTheExactStepWhereThereIsOne) {
  RoverRanges ranges;
  auto seen = four_sides();
  seen.step_rad = 2.0 * degree;
  seen.exact_step_rad = 2.5 * degree;
  seen.first_bearing_rad = -90.0 * degree;
  ASSERT_TRUE(ranges.take(seen));
  auto const& bearings = ranges.sensor()->bearings_rad;
  ASSERT_EQ(bearings.size(), 72U);
  EXPECT_NEAR(bearings.back(), 90.0 * degree, 1e-6);
  EXPECT_NEAR(bearings.front(), -87.5 * degree, 1e-6);
}

TEST(RoverRanges, LeaveOutWhatGivesNoScan) {
  RoverRanges ranges;
  auto seen = four_sides();
  seen.frame = MavFrame::global;
  EXPECT_FALSE(ranges.take(seen)) << "from north";
  seen = four_sides();
  seen.step_rad = 0.0;
  EXPECT_FALSE(ranges.take(seen)) << "all in one direction";
  seen = four_sides();
  seen.most_m = std::nullopt;
  EXPECT_FALSE(ranges.take(seen));
  EXPECT_EQ(ranges.sensor(), nullptr);
  EXPECT_FALSE(ranges.take(DistanceSensor{.most_m = 5.0, .distance_m = 1.0, .orientation = 25}, {})) << "down";
}

struct SingleSensors : ::testing::Test {
  std::optional<std::vector<float>> hear(std::uint8_t orientation, double distance_m, std::uint8_t id = 0) {
    return ranges.take(
        DistanceSensor{.least_m = 0.1, .most_m = 5.0, .distance_m = distance_m, .id = id, .orientation = orientation},
        now);
  }
  std::optional<std::vector<float>> hear_all() {
    now += 100ms;
    std::optional<std::vector<float>> scan;
    for (std::uint8_t const orientation : std::initializer_list<std::uint8_t>{0, 2, 6})
      if (auto made = hear(orientation, 1.0 + orientation)) scan = made;
    return scan;
  }
  RoverRanges ranges;
  base::TimePoint now{};
};

TEST_F(SingleSensors, MakeAScanOnceAllHaveSpoken) {
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(hear_all());
  std::optional<std::vector<float>> scan;
  for (int i = 0; i < 3; ++i) scan = hear_all();
  ASSERT_TRUE(scan);
  auto const& bearings = ranges.sensor()->bearings_rad;
  ASSERT_EQ(bearings.size(), 3U);
  EXPECT_NEAR(bearings[0], -90.0 * degree, 1e-6) << "orientation 2 looks to the right";
  EXPECT_FLOAT_EQ((*scan)[0], 3.0F);
  EXPECT_FLOAT_EQ((*scan)[1], 1.0F);
  EXPECT_FLOAT_EQ((*scan)[2], 0.0F) << "7 m is more than it can measure: it may be blind";
}

TEST_F(SingleSensors, DoNotCountWhenTheyHaveFallenSilent) {
  for (int i = 0; i < 15; ++i) (void)hear_all();
  std::optional<std::vector<float>> scan;
  for (int i = 0; i < 5; ++i) {
    now += 100ms;
    scan = hear(0, 1.0);
  }
  ASSERT_TRUE(scan);
  EXPECT_FLOAT_EQ((*scan)[0], 0.0F);
  EXPECT_FLOAT_EQ((*scan)[1], 1.0F);
}

TEST_F(SingleSensors, OfOneDirectionCountTheNearest) {
  for (int i = 0; i < 15; ++i) (void)hear_all();
  now += 100ms;
  (void)hear(0, 0.5, 10);
  (void)hear(0, 2.0, 11);
  now += 100ms;
  (void)hear(2, 3.0);
  now += 100ms;
  EXPECT_FLOAT_EQ(hear(2, 3.0).value()[1], 0.5F);
}

TEST_F(SingleSensors, AreNotNeededWhereSectorsAreTold) {
  EXPECT_TRUE(ranges.take(four_sides()));
  for (int i = 0; i < 15; ++i) EXPECT_FALSE(hear_all());
  EXPECT_EQ(ranges.sensor()->bearings_rad.size(), 4U);
}

TEST_F(SingleSensors, KeepTheMapsSensorWhenSectorsComeLater) {
  for (int i = 0; i < 15; ++i) (void)hear_all();
  EXPECT_FALSE(ranges.take(four_sides()));
  EXPECT_EQ(ranges.sensor()->bearings_rad.size(), 3U);
}

}  // namespace
}  // namespace lapwing::robot::rover
