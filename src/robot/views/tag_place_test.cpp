#include "robot/views/tag_place.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using Body = geo::Pose<geo::SiteFrame>;

/// Free from the origin up to a wall along x at y = 2 m, which has a gap from x = 3 to 4 m with nothing known behind.
map::OccupancyGrid hall() {
  map::OccupancyGrid grid(0.05);
  for (std::int32_t x = -40; x < 160; ++x) {
    for (std::int32_t y = -10; y < 40; ++y) grid.set({x, y}, map::Evidence::of_probability(0.1));
    if (x < 60 || x >= 80) grid.set({x, 40}, map::Evidence::of_probability(0.9));
  }
  return grid;
}

/// The box round what hangs there, as the camera of `body` has it in its picture.
vision::Box box_of(Body const& body, CameraMount const& mount, double x, double y, double up_m) {
  double const yaw = body.yaw_rad + mount.yaw_rad;
  double const from_x = body.position.x() + mount.x_m * std::cos(body.yaw_rad);
  double const from_y = body.position.y() + mount.x_m * std::sin(body.yaw_rad);
  double const ahead = (x - from_x) * std::cos(yaw) + (y - from_y) * std::sin(yaw);
  double const left = (y - from_y) * std::cos(yaw) - (x - from_x) * std::sin(yaw);
  double const up = up_m - mount.up_m;
  double const deep = ahead * std::cos(mount.pitch_rad) + up * std::sin(mount.pitch_rad);
  double const above = up * std::cos(mount.pitch_rad) - ahead * std::sin(mount.pitch_rad);
  double const focal_px = mount.width_px / 2.0 / std::tan(mount.view_rad / 2.0);
  return {.x = mount.width_px / 2.0 - focal_px * left / deep - 20.0,
          .y = mount.height_px / 2.0 - focal_px * above / deep - 10.0,
          .width = 40.0,
          .height = 20.0};
}

TEST(TagPlace, IsOnTheWallThatTheMapHasWhereTheTagIsSeen) {
  auto const grid = hall();
  for (double const yaw_rad : {0.0, 0.3, -0.3}) {
    CameraMount const mount{.yaw_rad = std::numbers::pi / 2.0};
    Body const body{{1.0, 0.4}, yaw_rad};
    auto const place = tag_place(grid, body, mount, box_of(body, mount, 1.2, 2.0, 1.5));
    ASSERT_TRUE(place) << yaw_rad;
    EXPECT_NEAR(place->wall.position.x(), 1.2, 0.05);
    EXPECT_NEAR(place->wall.position.y(), 2.0, 0.05);
    EXPECT_NEAR(place->height_m, 1.5, 0.05);
    EXPECT_NEAR(place->wall.facing_rad, -std::numbers::pi / 2.0, 0.25);
  }
}

TEST(WallSeen, FacesItsSideHoweverAslantItIsMet) {
  auto grid = hall();
  // Walls on a map are not straight to the cell.
  for (std::int32_t x = -40; x < 60; x += 3) {
    grid.set({x, 39}, map::Evidence::of_probability(0.9));
    grid.set({x, 40}, map::Evidence::of_probability(0.1));
  }
  CameraMount const ahead{.x_m = 0.0};
  double worst_rad = 0.0;
  for (double bearing_rad = 0.75; bearing_rad < 1.6; bearing_rad += 0.05) {
    auto const wall = wall_seen(grid, {{0.0, 0.4}, 0.0}, ahead, bearing_rad);
    ASSERT_TRUE(wall) << bearing_rad;
    worst_rad = std::max(worst_rad, std::abs(wall->facing_rad + std::numbers::pi / 2.0));
  }
  EXPECT_LT(worst_rad, 0.12);
}

TEST(TagPlace, IsLessSureAlongAWallThatIsSeenAslant) {
  auto const grid = hall();
  CameraMount const mount{.yaw_rad = std::numbers::pi / 4.0};
  Body const body{{0.0, 0.4}, 0.0};
  auto const aslant = tag_place(grid, body, mount, box_of(body, mount, 1.8, 2.0, 1.5));
  CameraMount const across{.yaw_rad = std::numbers::pi / 2.0};
  auto const straight = tag_place(grid, body, across, box_of(body, across, 0.1, 2.0, 1.5));
  ASSERT_TRUE(aslant);
  ASSERT_TRUE(straight);
  EXPECT_GT(aslant->covariance_m2(0, 0), straight->covariance_m2(0, 0));
}

TEST(TagPlace, HasACovarianceThatTheMapTakes) {
  auto const grid = hall();
  CameraMount const mount{.yaw_rad = std::numbers::pi / 2.0};
  for (double yaw_rad = -0.5; yaw_rad < 0.5; yaw_rad += 0.01) {
    Body const body{{1.0, 0.4}, yaw_rad};
    auto const place = tag_place(grid, body, mount, box_of(body, mount, 1.2, 2.0, 1.5));
    ASSERT_TRUE(place) << yaw_rad;
    EXPECT_EQ(place->covariance_m2(0, 1), place->covariance_m2(1, 0)) << yaw_rad;
  }
}

TEST(TagPlace, IsNoneThroughAGapOfTheMapNorAtAHeightWhereNobodyHangsOne) {
  auto const grid = hall();
  CameraMount const mount{.yaw_rad = std::numbers::pi / 2.0};
  Body const before_the_gap{{3.5, 0.4}, 0.0};
  EXPECT_FALSE(tag_place(grid, before_the_gap, mount, box_of(before_the_gap, mount, 3.5, 2.0, 1.5)));
  Body const before_the_wall{{1.0, 0.4}, 0.0};
  EXPECT_FALSE(tag_place(grid, before_the_wall, mount, box_of(before_the_wall, mount, 1.0, 2.0, 0.5)));
}

}  // namespace
}  // namespace lapwing::robot
