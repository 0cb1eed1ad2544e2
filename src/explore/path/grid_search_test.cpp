// Paths over standable cells: how they go where many cost the same.
#include "explore/path/grid_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "explore/testing/learnt_map.hpp"

namespace lapwing::explore {
namespace {

struct GridSearchTest : ::testing::Test, testing::LearntMap {
  GridSearchTest() : LearntMap{KnownMap(60, 40, 0.1, {.keep_off_m = 0.28, .wary_m = 0.5})} {}

  [[nodiscard]] std::vector<Cell> path(Cell from, Cell to) const {
    return GridSearch(map).path(map, {.from = from, .to = to, .radius_m = 0.18});
  }
};

/// Of one cell from the straight line between two others, in cells.
double aside(Cell cell, Cell from, Cell to) {
  auto const way = to - from;
  auto const at = cell - from;
  return std::abs(static_cast<double>(way.x) * at.y - static_cast<double>(way.y) * at.x) / length_of(way);
}

TEST_F(GridSearchTest, GoesStraightOverOpenFloor) {
  learn({0, 0}, {59, 39}, Knowledge::free);
  for (Cell const to : {Cell{50, 30}, Cell{50, 22}, Cell{10, 30}, Cell{50, 12}, Cell{14, 35}}) {
    Cell const from{10, 10};
    auto const found = path(from, to);
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found.front(), from);
    EXPECT_EQ(found.back(), to);
    auto const way = to - from;
    EXPECT_EQ(found.size(), std::max(std::abs(way.x), std::abs(way.y)) + 1U);
    for (auto const cell : found) EXPECT_LT(aside(cell, from, to), 0.75) << cell.x << ' ' << cell.y;
  }
}

TEST_F(GridSearchTest, KeepsItsCellsNextToOneAnotherAndStandable) {
  learn({1, 1}, {58, 38}, Knowledge::free);
  learn({30, 1}, {30, 28}, Knowledge::wall);
  auto const found = path({10, 5}, {50, 7});
  ASSERT_FALSE(found.empty());
  for (std::size_t i = 1; i < found.size(); ++i) {
    auto const step = found[i] - found[i - 1];
    EXPECT_EQ(std::max(std::abs(step.x), std::abs(step.y)), 1);
    EXPECT_TRUE(map.is_standable(found[i]));
  }
}

TEST_F(GridSearchTest, KeepsOffAWallThatAStraightLineWouldComeNearTo) {
  learn({0, 0}, {59, 39}, Knowledge::free);
  learn({28, 0}, {32, 12}, Knowledge::wall);  // the line at y = 16 is within the wary distance of its end
  auto const found = path({5, 16}, {55, 16});
  ASSERT_FALSE(found.empty());
  for (auto const cell : found)
    if (std::abs(cell.x - 30) <= 2) {
      EXPECT_FALSE(map.is_near_wall(cell)) << cell.x << ' ' << cell.y;
    }
}

TEST_F(GridSearchTest, LeavesAPlaceThatIsTooNearToAWallOverWhatARobotFitsOn) {
  learn({0, 0}, {59, 39}, Knowledge::free);
  learn({0, 0}, {59, 6}, Knowledge::wall);
  Cell const from{10, 9};  // it fits there, and is too near to stand
  ASSERT_FALSE(map.is_standable(from));
  auto const found = path(from, {40, 20});
  ASSERT_FALSE(found.empty());
  for (auto const cell : found) EXPECT_TRUE(map.has_room(map.middle(cell), 0.18)) << cell.x << ' ' << cell.y;
}

}  // namespace
}  // namespace lapwing::explore
