// What open frontiers seem to hide.
#include "explore/strategy/gain.hpp"

#include <gtest/gtest.h>

#include "explore/testing/learnt_map.hpp"

namespace lapwing::explore {
namespace {

/// Of 30 by 30 m, in cells of 0.1 m.
struct HiddenTest : ::testing::Test, testing::LearntMap {
  HiddenTest() : LearntMap{KnownMap(300, 300, 0.1, {})} {}

  /// Walls around them, and then what is inside.
  void learn_room(Cell least, Cell most) {
    learn(least + Cell{-1, -1}, most + Cell{1, 1}, Knowledge::wall);
    learn(least, most, Knowledge::free);
  }
  [[nodiscard]] double hidden() const { return hidden_m2(map, Frontiers(map).find_all(map), 5.0); }
};

TEST_F(HiddenTest, IsNothingWithoutOpenFrontiers) {
  learn_room({50, 50}, {100, 100});
  EXPECT_EQ(hidden(), 0.0);
}

TEST_F(HiddenTest, IsNoMoreBehindAnOpeningThanItIsWide) {
  learn_room({50, 50}, {100, 100});
  learn({101, 60}, {101, 69}, Knowledge::free);  // a door of 1 m
  double const by_a_door = hidden();
  EXPECT_GT(by_a_door, 2.0);
  EXPECT_LT(by_a_door, 8.0) << "half a circle of 2 m has 6.3";
  learn({70, 101}, {72, 101}, Knowledge::free);  // a gap of 0.3 m
  EXPECT_NEAR(hidden() - by_a_door, 0.5, 0.3);
}

TEST_F(HiddenTest, IsCountedOnceBehindTwoDoors) {
  learn_room({50, 50}, {100, 100});
  learn({101, 60}, {101, 69}, Knowledge::free);
  double const by_one = hidden();
  learn({101, 72}, {101, 81}, Knowledge::free);
  EXPECT_GT(hidden(), 1.1 * by_one);
  EXPECT_LT(hidden(), 1.7 * by_one) << "the two look at the same unknown in part";
}

TEST_F(HiddenTest, EndsAtKnownWalls) {
  learn_room({50, 50}, {100, 100});
  learn({101, 60}, {101, 69}, Knowledge::free);
  // Around a closet of 0.5 by 1 m, of which nothing else was seen.
  learn({102, 59}, {107, 59}, Knowledge::wall);
  learn({102, 70}, {107, 70}, Knowledge::wall);
  learn({107, 60}, {107, 69}, Knowledge::wall);
  EXPECT_NEAR(hidden(), 0.5, 1e-9);
}

}  // namespace
}  // namespace lapwing::explore
