#include "vision/signs/door_signs.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

/// A door that is seen at a slant, with a dark plate to the left of it.
Detection slanted() {
  return {.category = "door",
          .box = {300, 100, 100, 300},
          .corners = std::array<Point, 4>{Point{300, 100}, Point{400, 140}, Point{400, 360}, Point{300, 400}}};
}

TEST(DoorSigns, TheViewIsFromTheFrontAndLeadsBack) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar::all(220));
  cv::circle(picture, {300, 250}, 8, cv::Scalar::all(10), cv::FILLED);
  auto const view = view_of_door(picture, slanted());
  ASSERT_FALSE(view.pixels.empty());
  // The wall beside the door takes as much on either side, and some is above.
  auto const back = view.to_picture * cv::Vec3d(view.pixels.cols * 0.7 / 2.4, view.pixels.rows * 0.12 / 1.12, 1.0);
  EXPECT_NEAR(back[0] / back[2], 300.0, 3.0);
  EXPECT_NEAR(back[1] / back[2], 100.0, 3.0);
  cv::Mat grey;
  cv::cvtColor(view.pixels, grey, cv::COLOR_BGR2GRAY);
  cv::Point darkest;
  cv::minMaxLoc(grey, nullptr, nullptr, &darkest, nullptr);
  auto const spot = view.to_picture * cv::Vec3d(darkest.x, darkest.y, 1.0);
  EXPECT_NEAR(spot[0] / spot[2], 300.0, 10.0);
  EXPECT_NEAR(spot[1] / spot[2], 250.0, 10.0);
}

TEST(DoorSigns, WhatIsTooSmallToReadIsNotLookedAt) {
  cv::Mat const picture(480, 640, CV_8UC3, cv::Scalar::all(220));
  auto door = slanted();
  door.corners = std::array<Point, 4>{Point{0, 0}, Point{5, 0}, Point{5, 15}, Point{0, 15}};
  EXPECT_TRUE(view_of_door(picture, door).pixels.empty());
  door.corners.reset();
  EXPECT_TRUE(view_of_door(picture, door).pixels.empty());
}

TEST(DoorSigns, WithoutReadersNothingIsRead) {
  cv::Mat const picture(480, 640, CV_8UC3, cv::Scalar::all(220));
  SignFinder signs({});
  EXPECT_TRUE(signs_of_door(signs, picture, slanted()).empty());
}

}  // namespace
}  // namespace lapwing::vision
