#include "robot/views/viewpoint.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

constexpr double south_rad = -std::numbers::pi / 2.0;
/// To the sides, as robots of the simulated building have them.
constexpr std::array mounts{CameraMount{.yaw_rad = 1.8, .pitch_rad = 0.35},
                            CameraMount{.yaw_rad = 0.87, .pitch_rad = 0.35}};
OnWall const sign{.position = {2.0, 2.0}, .height_m = 1.4, .facing_rad = south_rad};

/// A wall along x at y = 2 m; before it free where `is_free(x, y)`.
map::OccupancyGrid wall_with(std::function<bool(double, double)> const& is_free) {
  map::OccupancyGrid grid(0.05);
  for (std::int32_t x = -40; x < 160; ++x) {
    for (std::int32_t y = -60; y < 40; ++y) {
      auto const at = grid.centre_of({x, y});
      grid.set({x, y}, map::Evidence::of_probability(is_free(at.x(), at.y()) ? 0.1 : 0.9));
    }
    grid.set({x, 40}, map::Evidence::of_probability(0.9));
  }
  return grid;
}

TEST(Viewpoint, IsStraightBeforeTheSignAndNear) {
  auto const grid = wall_with([](double, double) { return true; });
  auto const views = viewpoints_for(sign, grid, mounts);
  ASSERT_FALSE(views.empty());
  auto const& best = views.front();
  EXPECT_NEAR(best.from.x(), 2.0, 0.01);
  EXPECT_NEAR(best.from.y(), 0.8, 0.01);
  EXPECT_EQ(best.eye, 1U) << "the one that looks ahead more";
  EXPECT_EQ(best.bearing_rad, 0.87);
  for (auto const& view : views) EXPECT_LT(view.from.y(), 1.4) << "where the robot has room";
}

TEST(Viewpoint, IsAsideWhereSomethingStandsBeforeTheSign) {
  auto const grid = wall_with([](double x, double y) { return std::abs(x - 2.0) > 0.25 || y > 1.2; });
  auto const views = viewpoints_for(sign, grid, mounts);
  ASSERT_FALSE(views.empty());
  for (auto const& view : views) EXPECT_GT(std::abs(view.from.x() - 2.0), 0.4);
}

TEST(Viewpoint, IsNearInANarrowHallAndNowhereWhereTheRobotCannotStand) {
  auto const narrow = wall_with([](double, double y) { return y > 0.75; });
  auto const views = viewpoints_for(sign, narrow, mounts);
  ASSERT_FALSE(views.empty());
  for (auto const& view : views) EXPECT_GT(view.from.y(), 1.05);
  auto const closed = wall_with([](double, double y) { return y > 1.5; });
  EXPECT_TRUE(viewpoints_for(sign, closed, mounts).empty());
}

TEST(Viewpoint, IsNotThroughAGapOfTheMap) {
  auto grid = wall_with([](double, double) { return true; });
  for (std::int32_t x = -40; x < 160; ++x) grid.set({x, 34}, map::Evidence());
  EXPECT_TRUE(viewpoints_for(sign, grid, mounts).empty()) << "what is not known may hide it";
}

TEST(Viewpoint, IsWhereACameraHasTheSignInItsPicture) {
  auto const grid = wall_with([](double, double) { return true; });
  auto high = sign;
  high.height_m = 2.2;
  auto const views = viewpoints_for(high, grid, mounts);
  ASSERT_FALSE(views.empty());
  for (auto const& view : views) EXPECT_GT(geo::distance_m(view.from, view.at), 1.7);
  EXPECT_TRUE(viewpoints_for(high, grid, {}).empty()) << "without eyes";
}

TEST(Opening, IsADoorwayNearBy) {
  auto grid = wall_with([](double, double) { return true; });
  EXPECT_FALSE(is_beside_an_opening(sign, grid));
  auto before = sign;
  before.position = {2.0, 1.97};
  EXPECT_FALSE(is_beside_an_opening(before, grid)) << "whose place came out before the wall";
  auto const open = [&](std::int32_t from, std::int32_t to) {
    for (auto x = from; x < to; ++x)
      for (std::int32_t y = 40; y < 50; ++y) grid.set({x, y}, map::Evidence::of_probability(0.1));
  };
  open(46, 52);
  EXPECT_FALSE(is_beside_an_opening(sign, grid)) << "a gap of 30 cm";
  open(46, 64);
  EXPECT_TRUE(is_beside_an_opening(sign, grid));
  EXPECT_TRUE(is_beside_an_opening(before, grid));
  auto far = sign;
  far.position = {0.0, 2.0};
  EXPECT_FALSE(is_beside_an_opening(far, grid));
  open(46, 90);
  EXPECT_FALSE(is_beside_an_opening(sign, grid))
      << "the wall ends there, as a door's leaf does and walls between rooms";
}

TEST(WideEnough, IsAWallAndNotItsEnd) {
  auto grid = wall_with([](double, double) { return true; });
  EXPECT_TRUE(is_wide_enough(sign, grid));
  auto before = sign;
  before.position = {2.0, 1.92};
  EXPECT_TRUE(is_wide_enough(before, grid)) << "whose place came out before the wall";
  for (std::int32_t x = 42; x < 60; ++x) grid.set({x, 40}, map::Evidence::of_probability(0.1));
  EXPECT_FALSE(is_wide_enough(sign, grid)) << "it ends 10 cm beside";
}

}  // namespace
}  // namespace lapwing::robot
