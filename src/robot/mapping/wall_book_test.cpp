#include "robot/mapping/wall_book.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using GridPoint = geo::Point<map::GridFrame>;

slam::WallLine line(double x0, double y0, double x1, double y1) {
  return {.from = GridPoint(x0, y0), .to = GridPoint(x1, y1)};
}

TEST(WallBook, TellsOfNewWallsOnce) {
  WallBook book;
  auto const walls = std::vector{line(0, 0, 5, 0), line(0, 0, 0, 3)};
  auto const first = book.take(walls);
  ASSERT_EQ(first.put.size(), 2U);
  EXPECT_EQ(first.put[0].number, 1U);
  EXPECT_EQ(first.put[1].number, 2U);
  auto const again = book.take(walls);
  EXPECT_TRUE(again.put.empty());
  EXPECT_TRUE(again.removed.empty());
}

TEST(WallBook, KeepsTheNumberOfAWallThatGrowsAndMovesALittle) {
  WallBook book;
  (void)book.take({line(0, 0, 3, 0), line(0, 0, 0, 3)});
  // The order of walls is that of their lengths, which changes.
  auto const changes = book.take({line(0.05, 0.06, 0.05, 8.0), line(0, 0.03, 3.4, 0.05)});
  ASSERT_EQ(changes.put.size(), 2U);
  EXPECT_EQ(changes.put[0].number, 2U);
  EXPECT_EQ(changes.put[1].number, 1U);
  EXPECT_EQ(changes.put[0].line.to.y(), 8.0);
  EXPECT_TRUE(changes.removed.empty());
}

TEST(WallBook, TakesAwayWhatIsNotFoundAnyMore) {
  WallBook book;
  (void)book.take({line(0, 0, 3, 0), line(0, 0, 0, 3)});
  auto const changes = book.take({line(0, 0, 3, 0)});
  EXPECT_TRUE(changes.put.empty());
  EXPECT_EQ(changes.removed, std::vector<std::uint32_t>{2});
  EXPECT_EQ(book.walls().size(), 1U);
}

TEST(WallBook, GivesNoNumberTwice) {
  WallBook book;
  (void)book.take({line(0, 0, 3, 0)});
  (void)book.take({});
  EXPECT_EQ(book.take({line(0, 0, 3, 0)}).put.front().number, 2U);
}

TEST(WallBook, KeepsTheTwoFacesOfAThinWallApartWhicheverIsFoundFirst) {
  WallBook book;
  (void)book.take({line(0, 0, 4, 0), line(0, 0.12, 4, 0.12)});
  auto const changes = book.take({line(0, 0.12, 4, 0.12), line(0, 0, 4, 0)});
  EXPECT_TRUE(changes.put.empty());
  EXPECT_TRUE(changes.removed.empty());
}

TEST(WallBook, KeepsTheTwoSidesOfAWallApart) {
  WallBook book;
  (void)book.take({line(0, 0, 4, 0)});
  auto const changes = book.take({line(0, 0.25, 4, 0.25), line(0, 0, 4, 0)});
  ASSERT_EQ(changes.put.size(), 1U);
  EXPECT_EQ(changes.put.front().number, 2U);
  EXPECT_TRUE(changes.removed.empty());
}

}  // namespace
}  // namespace lapwing::robot
