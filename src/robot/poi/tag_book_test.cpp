#include "robot/poi/tag_book.hpp"

#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

TagSight sight(double x, double y, std::string const& name, double score, double facing_rad = 0.0, double sd_m = 0.1) {
  return {.place = {.wall = {.position = {x, y}, .range_m = 1.5, .facing_rad = facing_rad},
                    .height_m = 1.5,
                    .covariance_m2 = sd_m * sd_m * Eigen::Matrix2d::Identity()},
          .name = name,
          .kind = {},
          .score = score};
}

TEST(TagBook, MergesViewsOfOneTagAndWeighsThemByHowSureTheyAre) {
  TagBook book;
  auto const first = book.take(sight(1.0, 2.0, "221", 0.8, 0.0, 0.1));
  auto const both = book.take(sight(1.3, 2.0, "221", 0.8, 0.1, 0.2));
  ASSERT_EQ(book.tags().size(), 1U);
  EXPECT_EQ(both.number, first.number);
  EXPECT_EQ(both.sights, 2);
  EXPECT_NEAR(both.position.x(), 1.06, 1e-9);  // four times as sure of the first
  EXPECT_LT(both.covariance_m2(0, 0), first.covariance_m2(0, 0));
  EXPECT_GT(both.confidence(), first.confidence());
}

TEST(TagBook, TakesTheNameThatMostOfTheSightsRead) {
  TagBook book;
  (void)book.take(sight(1.0, 2.0, "271", 0.7));
  (void)book.take(sight(1.05, 2.0, "221", 0.6));
  EXPECT_EQ(book.tags().front().name(), "271");
  (void)book.take(sight(1.0, 2.05, "221", 0.6));
  ASSERT_EQ(book.tags().size(), 1U);
  EXPECT_EQ(book.tags().front().name(), "221");
}

TEST(TagBook, CountsWhatReadAPartOfTheNumberForTheWhole) {
  TagBook book;
  (void)book.take(sight(1.0, 2.0, "106", 0.9));
  (void)book.take(sight(1.0, 2.0, "106", 0.9));
  (void)book.take(sight(1.0, 2.0, "B-106", 0.8));
  ASSERT_EQ(book.tags().size(), 1U);
  EXPECT_EQ(book.tags().front().name(), "B-106");
  EXPECT_NEAR(book.tags().front().confidence(), 2.6 / 3.1, 1e-9);
  (void)book.take(sight(1.0, 2.0, "B-10", 0.8));
  EXPECT_NEAR(book.tags().front().confidence(), 2.6 / 3.9, 1e-9) << "a number that is cut off is another one";
}

TEST(TagBook, IsNamedByANumberHoweverOftenTheKindOfRoomAloneWasRead) {
  TagBook book;
  auto kind_alone = sight(1.0, 2.0, "", 0.9);
  kind_alone.kind = "meeting room";
  (void)book.take(kind_alone);
  EXPECT_EQ(book.tags().front().name(), "meeting room");
  (void)book.take(sight(1.0, 2.0, "223", 0.6));
  (void)book.take(kind_alone);
  ASSERT_EQ(book.tags().size(), 1U);
  EXPECT_EQ(book.tags().front().name(), "223");
}

TEST(TagBook, KeepsTagsApartThatHangElsewhereOrOnTheOtherSideOfTheWall) {
  TagBook book;
  (void)book.take(sight(1.0, 2.0, "221", 0.8));
  (void)book.take(sight(2.2, 2.0, "221", 0.8));
  (void)book.take(sight(1.0, 2.0, "221", 0.8, std::numbers::pi));
  (void)book.take(sight(1.6, 2.0, "223", 0.8));
  EXPECT_EQ(book.tags().size(), 4U) << "the last one reads otherwise and is farther off than places err";
}

TEST(TagBook, TellsNumberAndKindWhicheverWasReadMoreOften) {
  TagBook book;
  auto kind_alone = sight(1.0, 2.0, "", 0.5);
  kind_alone.kind = "meeting room";
  for (int i = 0; i < 3; ++i) (void)book.take(kind_alone);
  EXPECT_EQ(book.tags().front().text(), "meeting room");
  auto whole = sight(1.0, 2.0, "223", 0.7);
  whole.kind = "meeting room";
  (void)book.take(whole);
  EXPECT_EQ(book.tags().front().text(), "223 meeting room");
}

TEST(TagBook, KeepsThePictureOfTheSurestSightOfWhatItIsCalled) {
  TagBook book;
  auto const seen = [&](std::string const& name, double score) -> TagBook::Entry const& {
    auto one = sight(1.0, 2.0, name, score);
    one.crop = name + " of " + std::to_string(score).substr(0, 3);
    return book.take(one);
  };
  EXPECT_EQ(seen("221", 0.8).crop, "221 of 0.8");
  book.keep_picture(seen("221", 0.8).number, "kept");
  EXPECT_EQ(seen("271", 0.9).crop, "221 of 0.8") << "it is called 221";
  EXPECT_EQ(book.tags().front().picture, "kept");
  EXPECT_EQ(seen("221", 0.9).crop, "221 of 0.9");
  EXPECT_TRUE(book.tags().front().picture.empty()) << "of another crop";
}

/// What lies east of 3 m comes by so much to the west.
MapMove closing_up(double by_m) {
  return [by_m](geo::Pose<geo::SiteFrame> const& before) -> geo::Pose<geo::SiteFrame> {
    return {{before.position.x() - (before.position.x() > 3.0 ? by_m : 0.0), before.position.y()}, before.yaw_rad};
  };
}

TEST(TagBook, JoinsTwoThatComeTogetherWhenTheMapMoves) {
  TagBook book;
  auto const first = book.take(sight(2.0, 2.0, "108", 0.8)).number;
  auto clearer = sight(4.0, 2.0, "108", 0.9);
  clearer.crop = "clearer";
  auto const second = book.take(clearer).number;
  book.keep_picture(second, "kept");
  auto const joined = book.move(closing_up(1.7));
  ASSERT_EQ(joined.size(), 1U);
  EXPECT_EQ(joined[0].gone, second);
  EXPECT_EQ(joined[0].into, first);
  ASSERT_EQ(book.tags().size(), 1U);
  auto const& tag = book.tags()[0];
  EXPECT_EQ(tag.number, first);
  EXPECT_EQ(tag.sights, 2);
  EXPECT_NEAR(tag.position.x(), 2.15, 1e-9);
  EXPECT_NEAR(tag.confidence(), 1.7 / 2.2, 1e-9);
  EXPECT_EQ(tag.crop, "clearer");
  EXPECT_EQ(tag.picture, "kept");
}

/// The sign of 107 hangs north of a corridor, and was seen from a room south of it.
TagSight past_a_frame(map::SitePoint from, double x, std::string const& read = "107") {
  auto one = sight(x, 3.0, read, 0.8, -std::numbers::pi / 2.0);
  one.from = from;
  return one;
}

TEST(TagBook, TakesASightPastADoorFrameForTheSignAcrossTheCorridor) {
  for (bool const comes_first : {true, false}) {
    TagBook book;
    auto across = sight(2.0, 6.0, "107", 0.8, -std::numbers::pi / 2.0);
    across.from = {1.5, 4.5};
    if (!comes_first) (void)book.take(across);
    (void)book.take(past_a_frame({2.0, 1.0}, 2.05));
    (void)book.take(past_a_frame({1.8, 1.0}, 1.92));
    if (!comes_first) (void)book.take(past_a_frame({1.8, 1.0}, 1.92, "10"));  // the frame hides the rest
    if (comes_first) (void)book.take(across);
    (void)book.move([](geo::Pose<geo::SiteFrame> const& before) { return before; });
    ASSERT_EQ(book.tags().size(), 1U) << comes_first;
    EXPECT_NEAR(book.tags()[0].position.x(), 2.0, 1e-9);
    EXPECT_NEAR(book.tags()[0].position.y(), 6.0, 1e-9);
    EXPECT_EQ(book.tags()[0].sights, 1) << "as often as it was seen where it hangs";
    EXPECT_EQ(book.tags()[0].number, 1U);
    EXPECT_EQ(book.tags()[0].names.size(), 1U);
  }
}

TEST(TagBook, KeepsASecondSignOfARoomThatWasSeenFromElsewhere) {
  TagBook book;
  (void)book.take(past_a_frame({2.0, 1.0}, 2.05));
  (void)book.take(past_a_frame({4.0, 1.0}, 2.05));  // this line leads to where nothing hangs
  auto across = sight(2.0, 6.0, "107", 0.8, -std::numbers::pi / 2.0);
  across.from = {1.5, 4.5};
  (void)book.take(across);
  auto looks_away = sight(9.1, 7.0, "108", 0.8, std::numbers::pi / 2.0);
  (void)book.take(looks_away);
  auto other = past_a_frame({9.0, 1.0}, 9.05);
  other.name = "108";
  (void)book.take(other);
  EXPECT_EQ(book.tags().size(), 4U);
}

TEST(TagBook, GivesNoNumberTwiceAndFindsNoneThatIsGone) {
  TagBook book;
  (void)book.take(sight(2.0, 2.0, "108", 0.8));
  auto const second = book.take(sight(4.0, 2.0, "108", 0.9)).number;
  (void)book.move(closing_up(1.7));
  EXPECT_EQ(book.find(second), nullptr);
  book.keep_picture(second, "too late");
  auto const third = book.take(sight(9.0, 2.0, "109", 0.9)).number;
  EXPECT_GT(third, second);
  ASSERT_NE(book.find(third), nullptr);
  EXPECT_EQ(book.find(third)->name(), "109");
}

TEST(TagBook, KeepsApartWhatReadsOtherwiseAlsoWhenTheMapMoves) {
  TagBook book;
  (void)book.take(sight(2.0, 2.0, "108", 0.8));
  (void)book.take(sight(4.0, 2.0, "110", 0.9));
  EXPECT_TRUE(book.move(closing_up(1.2)).empty());
  EXPECT_EQ(book.tags().size(), 2U);
}

}  // namespace
}  // namespace lapwing::robot
