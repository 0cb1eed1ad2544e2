#include "robot/views/look_book.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using Outcome = LookBook::Outcome;

constexpr WallPiece piece{3, 4, 1};
constexpr double clear = 2.0 * LookBook::clear_px_m;
constexpr double aslant = 0.8 * LookBook::noticed_px_m;

/// How often it is looked at in a row, with the same outcome each time.
int looks(LookBook& book, double clearness, Outcome outcome) {
  int count = 0;
  for (; count < 100 && book.is_due(piece, clearness); ++count) book.note(piece, clearness, outcome);
  return count;
}

TEST(LookBook, LooksOnceWhereNothingIsWrittenTwiceWhereSomethingIsAndThreeTimesWhereThatIsNotRead) {
  for (auto const& [outcome, times] : {std::pair(Outcome::blank, 1), {Outcome::read, 2}, {Outcome::poor, 3}}) {
    LookBook book;
    EXPECT_EQ(looks(book, clear, outcome), times);
  }
}

TEST(LookBook, LooksAgainWhenWhatCouldNotBeReadIsSeenClearer) {
  LookBook book;
  EXPECT_EQ(looks(book, aslant, Outcome::poor), 3);
  EXPECT_FALSE(book.is_due(piece, 1.1 * aslant));
  EXPECT_EQ(looks(book, clear, Outcome::read), 2);
  EXPECT_FALSE(book.is_due(piece, 2.0 * clear)) << "it has been read";
}

TEST(LookBook, DoesNotBelieveFromAfarThatNothingIsWritten) {
  LookBook book;
  EXPECT_EQ(looks(book, aslant, Outcome::blank), 1);
  EXPECT_FALSE(book.is_due(piece, 0.9 * aslant));
  EXPECT_FALSE(book.is_due(piece, 1.2 * aslant)) << "that is not much clearer";
  EXPECT_EQ(looks(book, LookBook::noticed_px_m * 1.1, Outcome::blank), 1) << "a sign would be noticed at last";
  EXPECT_FALSE(book.is_due(piece, 3.0 * clear));
}

TEST(LookBook, KnowsWhatItPassedAndNeverSawClearly) {
  LookBook book;
  WallPoint const wall{.position = {1.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  EXPECT_TRUE(book.unclear().empty());
  book.pass(wall);
  ASSERT_EQ(book.unclear().size(), 1U) << "nobody has looked";
  book.note(piece_of(wall), aslant, Outcome::blank);
  ASSERT_EQ(book.unclear().size(), 1U);
  EXPECT_EQ(book.unclear().front().wall.position.x(), 1.3);
  EXPECT_FALSE(book.unclear().front().shows_something);
  book.note(piece_of(wall), clear, Outcome::cut_off);
  ASSERT_EQ(book.unclear().size(), 1U);
  EXPECT_TRUE(book.unclear().front().shows_something);
  book.note(piece_of(wall), clear, Outcome::poor);
  EXPECT_TRUE(book.unclear().empty()) << "who looks again looks for the sign";

  WallPoint const other{.position = {5.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  book.pass(other);
  book.give_up(piece_of(other));
  book.pass(other);
  EXPECT_TRUE(book.unclear().empty());
}

TEST(LookBook, GoesToWhatItNoticedFromAfarThoughSomebodyStoodBeforeItLater) {
  LookBook book;
  WallPoint const wall{.position = {1.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  book.pass(wall);
  book.note(piece_of(wall), 1.4 * LookBook::noticed_px_m, Outcome::poor);
  book.note(piece_of(wall), 1.7 * LookBook::noticed_px_m, Outcome::blank);
  ASSERT_EQ(book.unclear().size(), 1U);
  EXPECT_TRUE(book.unclear().front().shows_something);
  book.note(piece_of(wall), clear, Outcome::blank);
  EXPECT_TRUE(book.unclear().empty()) << "from so near nothing hides it";
}

TEST(LookBook, GivesUpNoWallThatComesToLieWhereAnotherWas) {
  LookBook book;
  WallPoint const wall{.position = {1.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  book.give_up(piece_of(wall));
  book.pass(wall);
  EXPECT_EQ(book.unclear().size(), 1U);
}

TEST(LookBook, TakesAWallThatFacesWestForOneHoweverItsAngleIsTold) {
  double const almost = std::numbers::pi - 0.01;
  EXPECT_EQ(piece_of({.position = {1.0, 1.0}, .facing_rad = almost}),
            piece_of({.position = {1.0, 1.0}, .facing_rad = -almost}));
  EXPECT_NE(piece_of({.position = {1.0, 1.0}, .facing_rad = 0.0}),
            piece_of({.position = {1.0, 1.0}, .facing_rad = almost}));
}

TEST(LookBook, GoesWithTheMapAndKeepsWhatWasSeen) {
  LookBook book;
  WallPoint const wall{.position = {1.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  WallPoint const other{.position = {5.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  book.pass(wall);
  book.pass(other);
  book.note(piece_of(wall), clear, Outcome::blank);
  book.move([](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
    return {{before.position.x() + 0.8, before.position.y()}, before.yaw_rad};
  });
  ASSERT_EQ(book.unclear().size(), 1U);
  EXPECT_NEAR(book.unclear().front().wall.position.x(), 6.1, 1e-9);
  auto there = wall;
  there.position = {2.1, 1.7};
  EXPECT_FALSE(book.is_due(piece_of(there), clear)) << "it has been looked at";
  EXPECT_TRUE(book.is_due(piece_of(wall), clear));
}

TEST(LookBook, GoesNowhereAgainForAWallThatAnotherHasComeToLieOn) {
  LookBook book;
  WallPoint const wall{.position = {1.3, 1.7}, .range_m = 1.5, .facing_rad = std::numbers::pi / 2.0};
  auto beside = wall;
  beside.position = {1.7, 1.7};
  book.pass(wall);
  book.give_up(piece_of(wall));
  book.note(piece_of(beside), aslant, Outcome::blank);
  book.move([](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
    return {{1.3, before.position.y()}, before.yaw_rad};
  });
  EXPECT_TRUE(book.unclear().empty());
  EXPECT_FALSE(book.is_due(piece_of(wall), aslant)) << "seen aslant, where it now is";
}

TEST(LookBook, IsDoneWithAPieceHoweverItIsSeen) {
  LookBook book;
  int count = 0;
  for (double clearness = 100.0; clearness < 1'600.0; clearness += 1.0) count += looks(book, clearness, Outcome::poor);
  EXPECT_LT(count, 35);
}

TEST(LookBook, TakesFewPicturesOfWallsWithNothingOnThem) {
  LookBook book;
  int count = 0;
  for (double clearness = 60.0; clearness < 1'600.0; clearness += 1.0) count += looks(book, clearness, Outcome::blank);
  EXPECT_LE(count, 4);
}

TEST(Clearness, IsLessFromAfarAndAslant) {
  CameraMount const mount;
  WallPoint wall{.position = {1.0, 2.0}, .range_m = 1.5, .facing_rad = -std::numbers::pi / 2.0};
  double const straight_rad = std::numbers::pi / 2.0;
  double const near = clearness(mount, wall, straight_rad);
  EXPECT_NEAR(near, 630.0, 15.0) << "960 pixels for the 1.52 m that it shows";
  EXPECT_NEAR(clearness(mount, wall, straight_rad + 1.0472), near / 2.0, 1.0);
  wall.range_m = 3.0;
  EXPECT_NEAR(clearness(mount, wall, straight_rad), near / 2.0, 1.0);
  EXPECT_EQ(clearness(mount, wall, -straight_rad), 0.0) << "from behind";
}

TEST(LookBook, BelievesInASignThatWasCutOffUntilItIsRead) {
  // A picture that shows the piece's edge alone tells nothing of what was cut off in another.
  LookBook book;
  WallPoint const wall{.position = {2.0, 2.0}, .range_m = 1.2, .facing_rad = -1.5};
  book.pass(wall);
  book.note(piece_of(wall), 360.0, LookBook::Outcome::cut_off);
  book.note(piece_of(wall), 870.0, LookBook::Outcome::blank);
  ASSERT_EQ(book.unclear().size(), 1U);
  EXPECT_TRUE(book.unclear().front().shows_something);
  book.note(piece_of(wall), 870.0, LookBook::Outcome::read);
  EXPECT_TRUE(book.unclear().empty());
}

}  // namespace
}  // namespace lapwing::robot
