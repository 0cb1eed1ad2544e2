#include "slam/known/known_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace lapwing::slam {
namespace {

/// A wall along x, from the origin on three metres to the right, one cell thick.
map::OccupancyGrid a_wall(double cell_m, geo::Transform<geo::SiteFrame, map::GridFrame> const& site_from_grid = {}) {
  map::OccupancyGrid grid(cell_m, site_from_grid);
  for (int x = 0; x < static_cast<int>(3.0 / cell_m); ++x) grid.set({x, 0}, map::Evidence::of_probability(0.9));
  grid.set({0, 40}, map::Evidence::of_probability(0.1));
  return grid;
}

TEST(KnownMap, TellsHowFarTheNearestWallIs) {
  auto const known = KnownMap::make(a_wall(0.05));
  ASSERT_TRUE(known);
  for (double const off_m : {0.1, 0.22, -0.33}) {
    auto const distance = known->distance({1.5, 0.025 + off_m});
    EXPECT_NEAR(distance.m, std::abs(off_m), 0.005) << off_m;
    EXPECT_NEAR(distance.slope.x(), 0.0, 0.01);
    EXPECT_NEAR(distance.slope.y(), off_m > 0 ? 1.0 : -1.0, 0.02);
  }
}

TEST(KnownMap, TellsNothingFarFromEveryWall) {
  auto const known = KnownMap::make(a_wall(0.05));
  for (Eigen::Vector2d const& place : {Eigen::Vector2d(1.5, 0.8), Eigen::Vector2d(1.5, 70.0),
                                       Eigen::Vector2d(-1e9, 0.0), Eigen::Vector2d(std::nan(""), 0.0)}) {
    EXPECT_EQ(known->distance(place).m, KnownMap::far_m);
    EXPECT_EQ(known->distance(place).slope, Eigen::Vector2f(0.0F, 0.0F));
  }
}

TEST(KnownMap, LiesWhereTheMapLies) {
  // Its corner is at (10, 5), and its x axis looks along y.
  auto const known = KnownMap::make(a_wall(0.05, {geo::Point<geo::SiteFrame>(10.0, 5.0), std::acos(0.0)}));
  ASSERT_TRUE(known);
  EXPECT_LT(known->distance({9.975, 6.5}).m, 0.05);
  EXPECT_NEAR(known->distance({9.775, 6.5}).m, 0.2, 0.04);
  EXPECT_NEAR(known->middle().y(), 6.5, 0.05);
}

TEST(KnownMap, TakesCoarseCellsAsTheyAre) {
  auto const known = KnownMap::make(a_wall(0.25));
  ASSERT_TRUE(known);
  EXPECT_NEAR(known->distance({1.5, 0.125}).m, 0.0, 0.01);
}

TEST(KnownMap, NeedsAWall) {
  map::OccupancyGrid grid(0.05);
  grid.set({0, 0}, map::Evidence::of_probability(0.1));
  auto const known = KnownMap::make(grid);
  ASSERT_FALSE(known);
  EXPECT_EQ(known.error().message, "no cell of the map is taken");
  grid.set({0, 0}, map::Evidence::of_probability(0.9));
  grid.set({900'000, 900'000}, map::Evidence::of_probability(0.9));
  EXPECT_EQ(KnownMap::make(grid).error().message, "the map is larger than a hundred million cells of 5 cm");
}

}  // namespace
}  // namespace lapwing::slam
