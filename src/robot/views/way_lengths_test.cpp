#include "robot/views/way_lengths.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

/// Known from 0 to 8 m both ways, with a wall across at x = 4 m that has a doorway from y = 6 to `to_m`.
map::OccupancyGrid two_rooms(double to_m) {
  map::OccupancyGrid grid(0.05);
  for (std::int32_t x = 0; x < 160; ++x)
    for (std::int32_t y = 0; y < 160; ++y) {
      bool const is_wall = x == 80 && (y < 120 || y * 0.05 >= to_m);
      grid.set({x, y}, map::Evidence::of_probability(is_wall ? 0.9 : 0.1));
    }
  return grid;
}

TEST(WayLengths, AreStraightWhereNothingStandsBetween) {
  WayLengths const ways(two_rooms(7.0), {1.0, 1.0});
  EXPECT_NEAR(ways.to({3.0, 1.0}).value(), 2.0, 0.1);
  EXPECT_NEAR(ways.to({1.0, 7.0}).value(), 6.0, 0.1);
  EXPECT_NEAR(ways.to({3.0, 4.0}).value(), 3.6, 0.3);
  EXPECT_LT(ways.to({1.0, 1.0}).value(), 0.1);
}

TEST(WayLengths, GoThroughTheDoorway) {
  WayLengths const ways(two_rooms(7.0), {3.5, 1.0});
  EXPECT_NEAR(ways.to({4.5, 1.0}).value(), 11.1, 0.5);
}

TEST(WayLengths, AreNoneWhereNoWayIsKnown) {
  EXPECT_FALSE(WayLengths(two_rooms(6.3), {3.5, 1.0}).to({4.5, 1.0})) << "too narrow";
  EXPECT_FALSE(WayLengths(two_rooms(7.0), {3.5, 1.0}).to({9.0, 1.0})) << "off the map";
}

TEST(WayLengths, BeginBesideAWall) {
  EXPECT_TRUE(WayLengths(two_rooms(7.0), {3.8, 1.0}).to({1.0, 1.0}));
}

}  // namespace
}  // namespace lapwing::robot
