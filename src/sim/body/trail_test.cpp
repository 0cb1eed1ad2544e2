#include "sim/body/trail.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/testing/ground.hpp"

namespace lapwing::sim {
namespace {

using namespace std::chrono_literals;
using namespace mavlink;

constexpr int smart_rtl = 21;

TEST(Trail, KeepsCornersAndForgetsStraightStretches) {
  Trail trail;
  trail.begin({});
  for (int i = 1; i <= 50; ++i) ASSERT_TRUE(trail.note({static_cast<double>(i), 0, 0}, {}));
  for (int i = 1; i <= 50; ++i) ASSERT_TRUE(trail.note({50, static_cast<double>(i), 0}, {}));
  auto const tidy = trail.tidied({});
  ASSERT_EQ(tidy.size(), 3u);
  EXPECT_EQ(tidy[1], (geo::Ned{50, 0, 0}));
}

TEST(Trail, LeavesOutRounds) {
  std::vector<geo::Ned> const round{{0, 0, 0}, {30, 0, 0}, {30, 30, 0}, {0, 30, 0}, {29, 1, 0}, {60, 0, 0}};
  auto const rest = without_loops(round, 2.0);
  ASSERT_EQ(rest.size(), 3u);
  EXPECT_EQ(rest[1].north, 30.0);
  EXPECT_EQ(rest[2].north, 60.0);
}

TEST(Trail, IsGivenUpWhenItCannotBeMadeShort) {
  Trail trail;
  Trail::Limits const few{.accuracy_m = 2.0, .most_points = 20};
  trail.begin({});
  bool told = false;
  // Ever wider zigzags: no point can be left out.
  for (int i = 1; i < 60; ++i) told = told || !trail.note({i * 5.0, (i % 2 == 0 ? 1 : -1) * i * 10.0, 0}, few);
  EXPECT_TRUE(told);
  EXPECT_FALSE(trail.usable());
  trail.begin({});
  EXPECT_TRUE(trail.usable());
}

TEST(SmartReturn, GoesBackTheWayThatLedThereAndLands) {
  TestGround ground("copter");
  ground.hover(20);
  ground.go_to(60, 0, 20, 20s);
  ground.go_to(60, 60, 30, 20s);
  ASSERT_EQ(ground.set_mode(smart_rtl), MavResult::accepted);
  double farthest_from_path_m = 0.0;
  bool passed_corner = false;
  ASSERT_TRUE(ground.run_until(
      [&] {
        auto const& p = ground.pilot().body().position_m;
        auto const& start = ground.vehicle().options().start;
        double const north = p.north - start.north;
        double const east = p.east - start.east;
        farthest_from_path_m = std::max(farthest_from_path_m, std::min(std::abs(north - 60.0), std::abs(east)));
        passed_corner = passed_corner || std::hypot(north - 60.0, east) < 4.0;
        return !ground.pilot().armed();
      },
      180s));
  EXPECT_TRUE(passed_corner);
  EXPECT_LT(farthest_from_path_m, 4.0);
  EXPECT_LT(ground.from_start(), 2.0);
}

TEST(SmartReturn, IsContinuedAfterAnInterruption) {
  TestGround ground("copter");
  ground.hover(10);
  ground.go_to(0, 50, 10, 15s);
  ground.go_to(50, 50, 10, 15s);
  ground.set_mode(smart_rtl);
  ground.run_for(4s);
  EXPECT_EQ(ground.set_mode(17), MavResult::accepted);
  ground.run_for(5s);
  EXPECT_EQ(ground.set_mode(smart_rtl), MavResult::accepted);
  EXPECT_TRUE(ground.run_until([&] { return !ground.pilot().armed(); }, 120s));
  EXPECT_LT(ground.from_start(), 2.0);
}

TEST(SmartReturn, IsRefusedWhenTheTrailWasGivenUp) {
  TestGround ground("copter");
  ground.set("SRTL_POINTS", 5.0F);
  ground.hover(10);
  for (int leg = 1; leg < 10; ++leg) {
    ground.go_to(leg * 15.0, leg % 2 == 0 ? 40.0 : 0.0, 10, 12s);
  }
  EXPECT_EQ(ground.said("SmartRTL deactivated: buffer full"), 1);
  EXPECT_EQ(ground.set_mode(smart_rtl), MavResult::failed);
  EXPECT_EQ(ground.said("Mode change to SMART_RTL failed: init failed"), 1);
}

TEST(SmartReturn, BringsARoverBackAndStopsIt) {
  TestGround ground("rover");
  ground.arm_in(rover_guided);
  ground.go_to(40, 0, 0, 25s);
  ground.go_to(40, 40, 0, 25s);
  EXPECT_EQ(ground.set_mode(12), MavResult::accepted);
  EXPECT_TRUE(ground.run_until([&] { return ground.said("Reached destination") == 1; }, 90s));
  EXPECT_LT(ground.from_start(), 4.0);
  ground.run_for(10s);
  EXPECT_EQ(ground.said("Reached destination"), 1);
  EXPECT_LT(ground.pilot().body().ground_speed_m_s(), 0.1);
}

}  // namespace
}  // namespace lapwing::sim
