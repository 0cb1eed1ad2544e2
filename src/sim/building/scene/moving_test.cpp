#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "sim/building/testing/small_building.hpp"

namespace lapwing::sim::building {
namespace {

using testing::small_building;
using testing::small_plan;

void pass(Building& building, double seconds) {
  double const until_s = building.time_s() + seconds;
  while (building.time_s() < until_s) building.step();
}

double range_north_m(Building const& building, double x) {
  auto const hit = building.surroundings().cast({x, 4.0}, {0, 1}, 10.0);
  return hit ? hit->range_m : -1.0;
}

TEST(Doors, OpenAndLetRaysThrough) {
  auto const building = small_building({{1, 1}, 0.0});
  // The leaf lies flush with the wall's outer side.
  EXPECT_NEAR(range_north_m(*building, 3.5), 1.05 - leaf_thickness_m, 1e-9);
  EXPECT_NEAR(range_north_m(*building, 5.0), 0.95, 1e-9);
  building->doors().hold(0, std::numbers::pi / 2.0);
  pass(*building, 3.0);
  EXPECT_EQ(range_north_m(*building, 3.5), -1.0);
  EXPECT_NEAR(building->true_doors()[0].angle_rad, std::numbers::pi / 2.0, 1e-9);
}

TEST(Doors, WaitForWhoStandsInTheWay) {
  auto plan = small_plan();
  plan.doors[0].opens_to = Side::right;  // inwards
  auto const building = small_building({{3.4, 4.4}, 0.0}, 1, plan);
  building->doors().hold(0, std::numbers::pi / 2.0);
  pass(*building, 5.0);
  double const stopped_rad = building->doors().angle_rad(0);
  EXPECT_LT(stopped_rad, 1.2);
  EXPECT_TRUE(building->collisions().empty());
  building->robot(0).body().put({{1, 1}, 0.0});
  pass(*building, 5.0);
  EXPECT_NEAR(building->doors().angle_rad(0), std::numbers::pi / 2.0, 1e-9);
}

TEST(Doors, MoveByTheirHabit) {
  auto plan = small_plan();
  plan.doors[0].habit = DoorHabit{10.0, 20.0};
  Doors doors(plan.doors, bodies_of(plan).doors, 1);
  constexpr double step_s = 0.05;
  constexpr int steps = 100'000;
  int open = 0;
  for (int i = 0; i < steps; ++i) {
    doors.step(step_s, [](auto const&) { return false; });
    if (doors.angle_rad(0) > 0.8) ++open;
  }
  EXPECT_NEAR(static_cast<double>(open) / steps, 1.0 / 3.0, 0.06);
}

TEST(People, WalkTheirWayAndStopBeforeARobot) {
  auto plan = small_plan();
  plan.people.push_back({.start = {{1, 2.5}, 0.0}, .walks = true, .way = {{7, 2.5}, {1, 2.5}}});
  auto const free = small_building({{4, 0.5}, 0.0}, 1, plan);
  double farthest = 0.0;
  for (int i = 0; i < 4'000; ++i) {
    free->step();
    farthest = std::max(farthest, free->people().all()[0].pose.position.x());
  }
  EXPECT_GT(farthest, 6.9);

  auto const blocked = small_building({{4, 2.5}, 0.0}, 1, plan);
  pass(*blocked, 30.0);
  EXPECT_LT(blocked->people().all()[0].pose.position.x(), 4.0 - 0.18 - People::radius_m - 0.3);
  EXPECT_TRUE(blocked->collisions().empty());
}

TEST(People, WanderWithoutTouchingWalls) {
  auto plan = small_plan();
  for (int i = 0; i < 4; ++i) plan.people.push_back({.start = {{1.0 + i, 2.0}, 0.0}, .walks = true});
  auto const building = small_building({{7, 4}, 0.0}, 1, plan);
  double walked_m = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    building->step();
    for (auto const& person : building->people().all()) {
      auto const& at = person.pose.position;
      ASSERT_GT(std::min({at.x(), at.y(), 8.0 - at.x(), 5.0 - at.y()}), People::radius_m) << i;
    }
  }
  for (auto const& person : building->people().all()) walked_m += person.walked_m;
  EXPECT_GT(walked_m, 20.0);
}

}  // namespace
}  // namespace lapwing::sim::building
