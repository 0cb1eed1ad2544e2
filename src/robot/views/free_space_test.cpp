#include "robot/views/free_space.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

/// Known from 0 to 4 m both ways, with a wall across at x = 2 m that has a doorway from y = 1 to 2 m.
map::OccupancyGrid two_rooms() {
  map::OccupancyGrid grid(0.05);
  for (std::int32_t x = 0; x < 80; ++x)
    for (std::int32_t y = 0; y < 80; ++y)
      grid.set({x, y}, map::Evidence::of_probability(x == 40 && (y < 20 || y >= 40) ? 0.9 : 0.1));
  return grid;
}

TEST(FreeSpace, IsNeitherWhereAWallIsNorWhereNothingIsKnown) {
  auto const grid = two_rooms();
  FreeSpace const space(grid);
  EXPECT_TRUE(space.is_free({1.0, 0.5}));
  EXPECT_FALSE(space.is_free({2.02, 0.5}));
  EXPECT_TRUE(space.is_taken({2.02, 0.5}));
  EXPECT_FALSE(space.is_free({5.0, 0.5}));
  EXPECT_FALSE(space.is_taken({5.0, 0.5}));
}

TEST(FreeSpace, HasRoomAwayFromWallsAndFromWhatIsNotKnown) {
  auto const grid = two_rooms();
  FreeSpace const space(grid);
  EXPECT_TRUE(space.has_room({1.0, 0.5}));
  EXPECT_TRUE(space.has_room({2.02, 1.5})) << "in the doorway";
  EXPECT_FALSE(space.has_room({1.8, 0.5}));
  EXPECT_FALSE(space.has_room({0.2, 0.5}));
}

TEST(FreeSpace, IsClearThroughTheDoorwayAlone) {
  auto const grid = two_rooms();
  FreeSpace const space(grid);
  EXPECT_TRUE(space.is_clear({1.0, 1.5}, {3.0, 1.5}));
  EXPECT_FALSE(space.is_clear({1.0, 0.5}, {3.0, 0.5}));
}

}  // namespace
}  // namespace lapwing::robot
