#include "sim/building/plan/building_plan.hpp"

#include <gtest/gtest.h>

#include "sim/building/plan/door_opening.hpp"
#include "sim/building/scene/faces.hpp"

namespace lapwing::sim::building {
namespace {

map::OccupancyGrid free_block(int width, int height) {
  map::OccupancyGrid grid(0.1, {geo::Point<geo::SiteFrame>(5.0, 7.0), 0.0});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) grid.set({x, y}, map::Evidence::of_probability(0.1));
  }
  return grid;
}

TEST(PlanOfMap, HasOneBorderForEachStraightPiece) {
  auto grid = free_block(300, 20);  // over a tile's edge
  grid.set({150, 10}, map::Evidence::of_probability(0.9));
  auto const plan = plan_of_map(grid, "m");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->borders.size(), 8U);
  auto const extent = extent_of(*plan);
  EXPECT_NEAR(extent->most.x(), 30.0, 1e-9);
  EXPECT_NEAR(extent->most.y(), 2.0, 1e-9);
  auto const origin = plan->site_from_floor * Place(0.0, 0.0);
  EXPECT_EQ(origin.x(), 5.0);
}

TEST(PlanOfMap, IsSolidToTheLeftOfEachBorder) {
  auto grid = free_block(20, 20);
  grid.set({10, 10}, map::Evidence::of_probability(0.9));
  auto const plan = plan_of_map(grid, "m").value();
  std::vector<Face> faces;
  for (auto const& border : plan.borders) faces.push_back({.from = border.from, .to = border.to});
  FaceIndex const index(faces);
  // The taken cell from all four sides, and the outer wall from inside.
  for (auto const& [from, way, range] :
       {std::tuple(Place(0.5, 1.05), Shift(1, 0), 0.5), std::tuple(Place(1.5, 1.05), Shift(-1, 0), 0.4),
        std::tuple(Place(1.05, 0.5), Shift(0, 1), 0.5), std::tuple(Place(1.05, 1.5), Shift(0, -1), 0.4),
        std::tuple(Place(0.5, 0.5), Shift(-1, 0), 0.5)}) {
    auto const hit = index.cast(from, way, 10.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range_m, range, 1e-9);
  }
}

TEST(PlanOfMap, RefusesAMapWithoutAnythingFree) {
  map::OccupancyGrid grid(0.05);
  grid.set({1, 1}, map::Evidence::of_probability(0.9));
  auto const plan = plan_of_map(grid, "m");
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().message, "the map has no free cell");
}

TEST(DoorOpening, IsFoundInTheWallWhoseLineHasBothJambs) {
  std::vector<WallPlan> const walls = {{.from = {0, 0}, .to = {4, 0}}, {.from = {4, 0}, .to = {4, 3}}};
  auto const opening = opening_of({.id = "a", .hinge = {4, 2}, .latch = {4, 1}}, walls);
  ASSERT_TRUE(opening);
  EXPECT_EQ(opening->wall, 1U);
  EXPECT_NEAR(opening->begin_m, 1.0, 1e-12);
  EXPECT_NEAR(opening->end_m, 2.0, 1e-12);
  EXPECT_FALSE(opening_of({.id = "a", .hinge = {3.5, 0}, .latch = {4.5, 0}}, walls));
  EXPECT_FALSE(opening_of({.id = "a", .hinge = {1, 0.02}, .latch = {2, 0}}, walls));
}

TEST(DoorOpening, LeavesWhatIsBetweenThem) {
  auto const left = stretches_between(10.0, {{.begin_m = 6, .end_m = 7}, {.begin_m = 0, .end_m = 1}});
  ASSERT_EQ(left.size(), 2U);
  EXPECT_EQ(left[0].begin_m, 1.0);
  EXPECT_EQ(left[0].end_m, 6.0);
  EXPECT_EQ(left[1].end_m, 10.0);
}

}  // namespace
}  // namespace lapwing::sim::building
