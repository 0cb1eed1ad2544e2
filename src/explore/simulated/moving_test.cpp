// Who moves on a simulated floor: people who meet robots, and carriers that meet each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "explore/simulated/carrier.hpp"
#include "explore/simulated/walkers.hpp"
#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

World empty_hall() {
  auto const plan = floor_plan_of(testing::drawn_grid(testing::hall)).value();
  return World::around(plan, {2.0, 5.0}, {}).value();
}

TEST(Walkers, StepAwayFromARobotThatHasComeNear) {
  auto const world = empty_hall();
  Random random(4);
  Walkers walkers(world, 1, {}, random);
  // A robot comes nearer than people come to robots, and stays.
  Disc const robot{walkers.discs().front().middle + Shift(0.5, 0.0), 0.18};
  double farthest_m = 0.0;
  for (int i = 0; i < 600; ++i) {
    walkers.step(world, 0.1, std::span(&robot, 1), random);
    farthest_m = std::max(farthest_m, distance_m(walkers.discs().front().middle, robot.middle));
  }
  EXPECT_GT(farthest_m, 1.0);
}

TEST(Walkers, DoNotWalkIntoRobots) {
  auto const world = empty_hall();
  Random random(5);
  Walkers walkers(world, 8, {}, random);
  Disc const robot{Place(10.0, 5.0) - world.plan_from_world(), 0.18};
  for (int i = 0; i < 5000; ++i) {
    auto const before = walkers.discs();
    walkers.step(world, 0.1, std::span(&robot, 1), random);
    auto const after = walkers.discs();
    for (std::size_t k = 0; k < after.size(); ++k) {
      double const far_m = distance_m(after[k].middle, robot.middle);
      EXPECT_TRUE(far_m > robot.radius_m + Walkers::radius_m || far_m >= distance_m(before[k].middle, robot.middle));
    }
  }
}

TEST(Carrier, SaysWhereItWouldStopAndStopsThere) {
  Carrier carrier({Place(1.0, 1.0), 0.3}, {});
  for (int i = 0; i < 30; ++i) carrier.drive({0.3, 0.4}, 0.1, [](Place const&) { return true; });
  auto const places = carrier.braking_places(0.1);
  ASSERT_FALSE(places.empty());
  EXPECT_GT(distance_m(places.back(), carrier.pose().position), 0.1);
  for (int i = 0; i < 30; ++i) carrier.drive({}, 0.1, [](Place const&) { return true; });
  EXPECT_LT(distance_m(places.back(), carrier.pose().position), 1e-9);
  EXPECT_TRUE(carrier.braking_places(0.1).empty());
}

TEST(Carrier, TwoThatDriveAtEachOtherStopApart) {
  constexpr double apart_m = 0.41;
  Carrier a({Place(0.0, 0.0), 0.0}, {});
  Carrier b({Place(3.0, 0.0), std::numbers::pi}, {});
  auto const step = [&](Carrier& who, Carrier const& other) {
    auto places = other.braking_places(0.1);
    places.push_back(other.pose().position);
    who.drive({0.3, 0.0}, 0.1, [&](Place const& place) {
      return std::ranges::all_of(places, [&](Place const& at) { return distance_m(at, place) >= apart_m; });
    });
  };
  for (int i = 0; i < 200; ++i) {
    step(a, b);
    step(b, a);
    ASSERT_GE(distance_m(a.pose().position, b.pose().position), apart_m - 1e-9) << i;
  }
}

}  // namespace
}  // namespace lapwing::explore
