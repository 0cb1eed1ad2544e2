#include "plan/estimate.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "plan/mission_builder.hpp"

namespace lapwing::plan {
namespace {

using geo::Wgs84;

auto const home = Wgs84::from_degrees(40.0, -8.0, 100.0);

struct EstimateTest : ::testing::Test {
  EstimateTest() { EXPECT_TRUE(builder.home(home)); }
  void move(double north_m, double up_m = 0.0) {
    EXPECT_TRUE(builder.waypoint(*builder.from_last({.north_m = north_m, .up_m = up_m})));
  }
  Estimate estimated(std::optional<Wgs84> start = std::nullopt) const { return estimate(*builder.finish("m"), start); }
  static double seconds(Estimate const& estimate) { return base::to_seconds(estimate.duration); }
  MissionBuilder builder;
};

TEST(Performance, OfARobotIsThatOfWheels) {
  EXPECT_FALSE(flies(vehicle::Family::robot));
  EXPECT_TRUE(flies(vehicle::Family::copter));
  EXPECT_EQ(performance_of(vehicle::Family::robot).cruise_m_s, performance_of(vehicle::Family::rover).cruise_m_s);
}

TEST_F(EstimateTest, OfNothingIsNothing) {
  EXPECT_EQ(estimated().path_m, 0.0);
  EXPECT_EQ(seconds(estimated()), 0.0);
}

TEST_F(EstimateTest, LegsTakeTheSlowerOfTheirWays) {
  move(100.0);         // 10 s level
  move(100.0, 100.0);  // 40 s climb
  move(0.0, -30.0);    // 20 s descent
  EXPECT_NEAR(estimated().path_m, 100.0 + 100.0 * std::numbers::sqrt2 + 30.0, 0.01);
  EXPECT_NEAR(seconds(estimated()), 70.0, 0.01);
  EXPECT_FALSE(estimated().is_endless);
}

TEST_F(EstimateTest, EndsForAWingWhereTheMissionSaysReturn) {
  move(1000.0);
  auto mission = *builder.finish("m");
  auto const plane = performance_of(vehicle::Family::plane);
  auto const before = estimate(mission, home, plane);
  mission.items.push_back({.command = mavlink::MavCmd::nav_return_to_launch});
  mission.items.push_back(mission.items.front());
  auto const after = estimate(mission, home, plane);
  EXPECT_FALSE(after.is_endless);
  EXPECT_EQ(after.duration, before.duration);
}

TEST_F(EstimateTest, StartsWhereTheVehicleIs) {
  move(0.0);
  EXPECT_NEAR(estimated(geo::displaced(home, {.north = 0.0, .east = 50.0})).path_m, 50.0, 0.01);
}

TEST_F(EstimateTest, MissionWithoutHomeStartsAtItsFirstPlace) {
  MissionBuilder homeless;
  ASSERT_TRUE(homeless.waypoint(home));
  EXPECT_EQ(estimate(*homeless.finish("m")).path_m, 0.0);
}

TEST_F(EstimateTest, FollowsSpeedChanges) {
  ASSERT_TRUE(builder.change_speed(5.0, 0));
  move(100.0);
  ASSERT_TRUE(builder.change_speed(1.0, 2));
  move(0.0, 10.0);
  ASSERT_TRUE(builder.change_speed(2.0, 3));
  move(0.0, -10.0);
  EXPECT_NEAR(seconds(estimated()), 20.0 + 10.0 + 5.0, 0.01);
}

TEST_F(EstimateTest, CountsCirclesAndWaits) {
  ASSERT_TRUE(builder.loiter(home, {.kind = Loiter::Kind::turns, .amount = 2.0, .radius_m = -50.0}));
  ASSERT_TRUE(builder.loiter(home, {.kind = Loiter::Kind::time, .amount = 30.0}));
  ASSERT_TRUE(builder.delay(7.0));
  EXPECT_NEAR(estimated().path_m, 200.0 * std::numbers::pi, 0.01);
  EXPECT_NEAR(seconds(estimated()), 20.0 * std::numbers::pi + 37.0, 0.01);
}

TEST_F(EstimateTest, CountsTheClimbOfAnAltitudeChange) {
  ASSERT_TRUE(builder.change_altitude(125.0));
  EXPECT_NEAR(seconds(estimated()), 10.0, 1e-6);
}

TEST_F(EstimateTest, FliesJumpsAsOftenAsAsked) {
  ASSERT_TRUE(builder.delay(1.0));
  ASSERT_TRUE(builder.delay(2.0));
  ASSERT_TRUE(builder.jump(2, 3));
  EXPECT_NEAR(seconds(estimated()), 1.0 + 4 * 2.0, 1e-6);
}

TEST_F(EstimateTest, JumpsAheadLeaveOut) {
  ASSERT_TRUE(builder.jump(3, 1));
  ASSERT_TRUE(builder.delay(1.0));
  ASSERT_TRUE(builder.delay(2.0));
  EXPECT_NEAR(seconds(estimated()), 2.0, 1e-6);
}

TEST_F(EstimateTest, KnowsWhatNeverEnds) {
  auto endless_jump = builder;
  ASSERT_TRUE(endless_jump.delay(1.0));
  ASSERT_TRUE(endless_jump.jump(1, -1));
  EXPECT_TRUE(estimate(*endless_jump.finish("m")).is_endless);
  auto long_jump = builder;
  ASSERT_TRUE(long_jump.delay(1000.0));
  ASSERT_TRUE(long_jump.jump(1, 32'767));
  EXPECT_TRUE(estimate(*long_jump.finish("m")).is_endless);
  ASSERT_TRUE(builder.loiter(home, {}));
  EXPECT_TRUE(estimated().is_endless);
}

TEST(Estimate, ComparesNothingWithNextToNothing) {
  EXPECT_EQ(to_text({.estimate = {.path_m = 75.0, .duration = std::chrono::seconds(10)},
                     .path_m = 1e-6,
                     .duration = std::chrono::seconds(10)}),
            "10 s and 0 m flown, 10 s (+0 %) and 75 m estimated");
}

}  // namespace
}  // namespace lapwing::plan
