#include "robot/planner/planning_area.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

constexpr double tile_m = map::tile_cells * 0.05;

TEST(PlanningArea, GrowsWhereSomethingIsSeenAndATileBeyond) {
  PlanningArea area(0.05);
  int const side = area.width();
  EXPECT_EQ(area.height(), side);
  EXPECT_FALSE(area.grow(std::vector<map::TileKey>{{0, 0}, {-2, 1}}));
  EXPECT_TRUE(area.grow(std::vector<map::TileKey>{{4, 0}}));
  EXPECT_EQ(area.width(), side + 4 * map::tile_cells);
  EXPECT_EQ(area.height(), side);
  EXPECT_FALSE(area.grow(std::vector<map::TileKey>{{5, 0}}));
  EXPECT_TRUE(area.grow(std::vector<map::TileKey>{{-3, -3}}));
  EXPECT_EQ(area.width(), side + 6 * map::tile_cells);
  EXPECT_EQ(area.height(), side + 2 * map::tile_cells);
}

TEST(PlanningArea, PlacesAreWhereTheyWereAfterItHasGrown) {
  PlanningArea area(0.05);
  ASSERT_TRUE(area.grow(std::vector<map::TileKey>{{-5, 3}}));
  Place const place(-4.7 * tile_m, 3.2 * tile_m);
  auto const back = area.on_map(area.on_floor(place));
  EXPECT_NEAR(back.x(), place.x(), 1e-9);
  EXPECT_NEAR(back.y(), place.y(), 1e-9);
  auto const cell = explore::cell_under(area.on_floor({-5.0 * tile_m + 0.01, 3.0 * tile_m + 0.01}), 0.05);
  EXPECT_EQ(cell, area.lowest_cell_of({-5, 3}));
}

TEST(PlanningArea, DoesNotGrowWithoutEndForWhatIsSeenFarAway) {
  PlanningArea area(0.05);
  int const side = area.width();
  EXPECT_FALSE(area.grow(std::vector<map::TileKey>{{8'000'000, 0}}));
  EXPECT_TRUE(area.is_cut_off());
  EXPECT_FALSE(area.contains({8'000'000, 0}));
  EXPECT_EQ(area.width(), side);
  EXPECT_TRUE(area.grow(std::vector<map::TileKey>{{8'000'000, 0}, {50, 0}}));
  EXPECT_GT(area.width(), side);
  EXPECT_LE(std::int64_t{area.width()} * area.height(), PlanningArea::most_cells);
}

}  // namespace
}  // namespace lapwing::robot
