#include "robot/mapping/pose_check.hpp"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using Place = geo::Point<map::GridFrame>;

/// A round room of 2 m, known from its middle.
map::OccupancyGrid round_room() {
  map::OccupancyGrid grid(0.05);
  for (int y = -40; y <= 40; ++y)
    for (int x = -40; x <= 40; ++x)
      if (std::hypot(x, y) <= 40.0)
        grid.set({x, y}, map::Evidence::of_probability(std::hypot(x, y) > 38.0 ? 0.95 : 0.05));
  return grid;
}

std::vector<Place> ring_of(double radius_m) {
  std::vector<Place> ends;
  for (int i = 0; i < 360; ++i) {
    double const angle = i * std::numbers::pi / 180.0;
    ends.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle));
  }
  return ends;
}

TEST(PoseCheck, AScanFitsWhereItsEndsLieOnWalls) {
  auto const grid = round_room();
  EXPECT_EQ(misfit(grid, ring_of(1.95)), 0.0);
  EXPECT_EQ(misfit(grid, ring_of(1.75)), 0.0) << "a map that a loop has not moved yet";
  EXPECT_EQ(misfit(grid, ring_of(1.0)), 1.0);
  EXPECT_EQ(misfit(grid, ring_of(5.0)), std::nullopt) << "nobody knows what is there";
}

TEST(PoseCheck, IsLostAfterAWhileOfScansThatDoNotFitAndFoundAfterSomeThatDo) {
  PoseCheck check;
  EXPECT_FALSE(check.feed(0.0, 0.9));
  EXPECT_FALSE(check.feed(1.9, 0.9));
  EXPECT_FALSE(check.feed(1.95, 0.1)) << "somebody stood before it";
  EXPECT_FALSE(check.feed(2.0, 0.9));
  EXPECT_FALSE(check.feed(3.0, std::nullopt)) << "who knows nothing is not lost";
  EXPECT_FALSE(check.feed(4.0, 0.9));
  EXPECT_TRUE(check.feed(6.0, 0.9));
  EXPECT_TRUE(check.feed(7.0, 0.5));
  EXPECT_TRUE(check.feed(8.0, 0.1));
  EXPECT_FALSE(check.feed(9.0, 0.1));
}

}  // namespace
}  // namespace lapwing::robot
