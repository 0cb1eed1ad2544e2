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

}  // namespace
}  // namespace lapwing::robot
