#include "robot/views/seen_walls.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "robot/views/look_book.hpp"

namespace lapwing::robot {
namespace {

constexpr double north_rad = std::numbers::pi / 2.0;
CameraMount const ahead{.x_m = 0.0, .pitch_rad = 0.35};

/// Free floor with a wall along x at y = 2 m.
map::OccupancyGrid wall() {
  map::OccupancyGrid grid(0.05);
  for (std::int32_t x = -200; x < 200; ++x) {
    for (std::int32_t y = -240; y < 40; ++y) grid.set({x, y}, map::Evidence::of_probability(0.1));
    grid.set({x, 40}, map::Evidence::of_probability(0.9));
  }
  return grid;
}

/// The clearest of what is seen from so far before the wall, looking so much aside; 0: nothing.
double clearest(double away_m, double aside_rad) {
  double best = 0.0;
  geo::Pose<geo::SiteFrame> const body{{0.0, 2.0 - away_m}, north_rad + aside_rad};
  for (auto const& seen : walls_in_picture(wall(), ahead, body)) best = std::max(best, seen.clearness);
  return best;
}

TEST(SeenWalls, AreClearFromNearAndNoticedFromAfar) {
  EXPECT_GT(clearest(1.5, 0.0), LookBook::clear_px_m);
  double const from_afar = clearest(4.0, 0.0);
  EXPECT_LT(from_afar, LookBook::clear_px_m);
  EXPECT_GT(from_afar, LookBook::noticed_px_m);
  EXPECT_EQ(clearest(6.0, 0.0), 0.0);
}

TEST(SeenWalls, AreNotSeenFromAfarAndAslant) {
  EXPECT_GT(clearest(1.2, 0.9), 0.0);
  EXPECT_GT(clearest(3.5, 0.7), LookBook::noticed_px_m);
  EXPECT_EQ(clearest(3.5, 1.0), 0.0) << "letters are too narrow";
}

TEST(SeenWalls, AreReadableUpToThreeMetres) {
  WallPoint const before{.position = {0.0, 2.0}, .range_m = 2.9, .facing_rad = -north_rad};
  EXPECT_TRUE(is_readable(before, north_rad));
  EXPECT_FALSE(is_readable(before, north_rad + 1.1));
  EXPECT_FALSE(is_readable({.position = {0.0, 2.0}, .range_m = 3.1, .facing_rad = -north_rad}, north_rad));
}

TEST(SeenWalls, AreNotClearWhereTheEdgeOfThePictureMayCutASignOff) {
  auto low = ahead;
  low.pitch_rad = 0.0;
  geo::Pose<geo::SiteFrame> const near{{0.0, 1.1}, north_rad};
  for (auto const& seen : walls_in_picture(wall(), low, near)) EXPECT_LT(seen.clearness, LookBook::noticed_px_m);
}

TEST(SeenWalls, AreAllRoundARobotAlsoAcrossAHall) {
  auto const grid = wall();
  int pieces = 0;
  for (auto const& piece : walls_round(grid, {{0.0, 0.5}, 0.3})) {
    EXPECT_NEAR(piece.position.y(), 2.0, 0.06);
    ++pieces;
  }
  EXPECT_GT(pieces, 30);
  EXPECT_GT(walls_round(grid, {{0.0, -8.0}, 0.3}).size(), 10U);
  EXPECT_TRUE(walls_round(grid, {{0.0, -11.0}, 0.3}).empty());
}

}  // namespace
}  // namespace lapwing::robot
