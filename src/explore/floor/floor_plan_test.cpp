// From a map to the world of one start: what is free, who fits where, what is to be seen.
#include "explore/floor/floor_plan.hpp"

#include <gtest/gtest.h>

#include "explore/run/starts.hpp"
#include "explore/simulated/world.hpp"
#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

using testing::drawn_grid;

TEST(FloorPlan, WhatIsTakenOrUnknownIsNotFree) {
  auto const plan = floor_plan_of(drawn_grid({"###", "# ?", "###"}, 0.1));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_EQ(plan->is_free.width(), 3);
  EXPECT_EQ((plan->is_free[{1, 1}]), 1);
  EXPECT_EQ((plan->is_free[{0, 1}]), 0);
  EXPECT_EQ((plan->is_free[{2, 1}]), 0);
}

TEST(FloorPlan, LargeCellsAreDivided) {
  auto const plan = floor_plan_of(drawn_grid({"###", "# #", "###"}, 0.5, 0.5));
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_NEAR(plan->cell_m, 0.1, 1e-12);
  EXPECT_EQ(plan->is_free.width(), 15);
  EXPECT_EQ((plan->is_free[{5, 5}]), 1);
  EXPECT_EQ((plan->is_free[{4, 5}]), 0);
}

TEST(FloorPlan, TheOriginMayBeTurned) {
  map::OccupancyGrid grid(0.1, {map::SitePoint(5.0, -2.0), 1.0});
  grid.set({10, 20}, map::Evidence::of_probability(0.03));
  auto const plan = floor_plan_of(grid);
  ASSERT_TRUE(plan) << plan.error().message;
  auto const here = plan->site_from_floor * middle_of({0, 0}, plan->cell_m);
  auto const there = grid.site_from_grid() * grid.centre_of({10, 20});
  EXPECT_NEAR(distance_m(here, there), 0.0, 1e-9);
}

TEST(FloorPlan, OneWithoutFreeCellsIsRefused) {
  auto const plan = floor_plan_of(drawn_grid({"##", "##"}));
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().kind, base::ErrorKind::invalid_input);
  EXPECT_NE(plan.error().hint.find("negate"), std::string::npos);
}

struct WorldTest : ::testing::Test {
  Settings settings;
  FloorPlan plan = floor_plan_of(drawn_grid(testing::two_rooms)).value();

  [[nodiscard]] std::string refusal(Place const& start) const {
    auto const world = World::around(plan, start, settings);
    return world ? "none" : world.error().message;
  }
};

TEST_F(WorldTest, EveryFreeCellOfTwoRoomsIsWanted) {
  auto const world = World::around(plan, {2.0, 2.0}, settings);
  ASSERT_TRUE(world) << world.error().message;
  std::size_t free = 0;
  for (std::size_t i = 0; i < plan.is_free.size(); ++i) free += plan.is_free.at_index(i);
  EXPECT_EQ(world->wanted(), free);
}

TEST_F(WorldTest, AStartInAWallIsRefusedByPlace) {
  EXPECT_EQ(refusal({0.2, 0.2}), "the robot cannot start at 0.20, 0.20: there is a wall, or nothing is known of it");
  EXPECT_EQ(refusal({-4.0, 2.0}), "the robot cannot start at -4.00, 2.00: that is outside of the floor plan");
  EXPECT_EQ(refusal({0.55, 2.0}), "the robot cannot start at 0.55, 2.00: the robot would touch a wall");
}

TEST_F(WorldTest, RobotsStartApart) {
  settings.robots = 8;
  auto const world = World::around(plan, {2.0, 2.0}, settings);
  ASSERT_TRUE(world) << world.error().message;
  auto const starts = starts_around(*world, {Place(2.0, 2.0) - world->plan_from_world(), 0.0}, settings);
  ASSERT_TRUE(starts) << starts.error().message;
  ASSERT_EQ(starts->size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(distance_m((*starts)[i].position, (*starts)[j].position), 2.0 * settings.carrier.radius_m);
  }
}

TEST_F(WorldTest, StartsAreIndoors) {
  // A house in a garden: the garden reaches the edge.
  auto const house = floor_plan_of(drawn_grid({
      "                ",
      "                ",
      "  ############  ",
      "  #          #  ",
      "  #          #  ",
      "  #          #  ",
      "  #          #  ",
      "  #          #  ",
      "  ############  ",
      "                ",
      "                ",
  }));
  ASSERT_TRUE(house) << house.error().message;
  auto const starts = possible_starts(*house, settings);
  ASSERT_FALSE(starts.empty());
  for (auto const& start : starts) {
    EXPECT_GT(start.x(), 1.5);
    EXPECT_LT(start.x(), 6.5);
  }
}

}  // namespace
}  // namespace lapwing::explore
