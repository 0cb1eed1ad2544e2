#include "vision/evaluate.hpp"

#include <gtest/gtest.h>

namespace lapwing::vision {
namespace {

Detection door(double x, double score) {
  return {.category = "door", .box = {x, 0.0, 10.0, 20.0}, .score = score};
}

TEST(Evaluate, OverlapIsThePartOfTheUnion) {
  EXPECT_DOUBLE_EQ(overlap({0, 0, 10, 10}, {0, 0, 10, 10}), 1.0);
  EXPECT_DOUBLE_EQ(overlap({0, 0, 10, 10}, {5, 0, 10, 10}), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(overlap({0, 0, 10, 10}, {10, 0, 10, 10}), 0.0);
  EXPECT_DOUBLE_EQ(overlap({0, 0, 0, 0}, {0, 0, 0, 0}), 0.0);
}

TEST(Evaluate, EachThingIsFoundOnce) {
  Judged const picture{.found = {door(0.0, 0.9), door(1.0, 0.8), door(50.0, 0.7)}, .truth = {{0, 0, 10, 20}}};
  auto const figures = evaluate(std::span(&picture, 1), 0.0);
  EXPECT_EQ(figures.right, 1U);
  EXPECT_EQ(figures.wrong, 2U);
  EXPECT_DOUBLE_EQ(figures.precision(), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(figures.recall(), 1.0);
  EXPECT_DOUBLE_EQ(figures.wrong_a_picture(), 2.0);
  EXPECT_DOUBLE_EQ(figures.average_precision, 1.0);
}

TEST(Evaluate, TheThresholdCountsForTheFiguresAndNotForTheAverage) {
  std::vector<Judged> const pictures{{.found = {door(0.0, 0.9)}, .truth = {{50, 0, 10, 20}}},
                                     {.found = {door(0.0, 0.4)}, .truth = {{0, 0, 10, 20}}}};
  auto const figures = evaluate(pictures, 0.5);
  EXPECT_EQ(figures.right, 0U);
  EXPECT_EQ(figures.wrong, 1U);
  EXPECT_EQ(figures.there, 2U);
  EXPECT_DOUBLE_EQ(figures.average_precision, 0.25);
}

TEST(Evaluate, WithoutPicturesThereIsNothingToDivideBy) {
  auto const figures = evaluate({}, 0.5);
  EXPECT_DOUBLE_EQ(figures.precision(), 0.0);
  EXPECT_DOUBLE_EQ(figures.recall(), 0.0);
  EXPECT_DOUBLE_EQ(figures.wrong_a_picture(), 0.0);
}

}  // namespace
}  // namespace lapwing::vision
