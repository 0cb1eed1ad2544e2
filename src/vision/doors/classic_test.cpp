#include "vision/doors/classic.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

cv::Scalar const wall(215, 220, 222);
cv::Scalar const wood(45, 85, 140);
cv::Scalar const red(30, 30, 190);

cv::Mat corridor(cv::Rect const& door, cv::Scalar const& colour) {
  cv::Mat picture(480, 640, CV_8UC3, wall);
  cv::rectangle(picture, door, colour, cv::FILLED);
  cv::circle(picture, {door.x + door.width - 15, door.y + door.height / 2}, 6, {190, 190, 190}, cv::FILLED);
  return picture;
}

TEST(Classic, FindsADoorByItsColour) {
  cv::Rect const door(250, 90, 140, 330);
  auto const found = doors_by_colour(corridor(door, wood));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found.front().category, "door");
  EXPECT_GT(overlap(found.front().box, {250, 90, 140, 330}), 0.95);
  EXPECT_GT(found.front().score, 0.9);
}

TEST(Classic, TheColourIsASetting) {
  cv::Rect const door(250, 90, 140, 330);
  EXPECT_TRUE(doors_by_colour(corridor(door, red)).empty());
  // Red lies on both sides of hue 0.
  auto const found = doors_by_colour(corridor(door, red), {.lowest = {170, 80, 40}, .highest = {6, 255, 255}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(overlap(found.front().box, {250, 90, 140, 330}), 0.95);
}

TEST(Classic, WhatIsSmallOrLiesIsNoDoor) {
  EXPECT_TRUE(doors_by_colour(corridor({250, 200, 25, 60}, wood)).empty());
  EXPECT_TRUE(doors_by_colour(corridor({50, 300, 500, 90}, wood)).empty());
}

TEST(Classic, BoxesAreInPixelsOfTheLargePicture) {
  cv::Mat large;
  cv::resize(corridor({250, 90, 140, 330}, wood), large, {}, 4.0, 4.0);
  auto const found = doors_by_colour(large);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_GT(overlap(found.front().box, {1000, 360, 560, 1320}), 0.95);
}

TEST(Classic, PicturesOfAlmostNothingHaveNoDoors) {
  EXPECT_TRUE(doors_by_colour({}).empty());
  EXPECT_TRUE(doors_by_colour(cv::Mat(1, 4000, CV_8UC3, wall)).empty());
}

}  // namespace
}  // namespace lapwing::vision
