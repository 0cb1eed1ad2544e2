#include "vision/doors/door_shape.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

using Points = std::vector<cv::Point>;

double farthest(Quadrilateral const& corners, Points const& truth) {
  double most = 0.0;
  for (std::size_t k = 0; k < truth.size(); ++k)
    most = std::max(most,
                    cv::norm(corners[k] - cv::Point2f(static_cast<float>(truth[k].x), static_cast<float>(truth[k].y))));
  return most;
}

cv::Mat drawn(Points const& door) {
  cv::Mat picture(480, 640, CV_8UC3, cv::Scalar(205, 214, 220));
  if (!door.empty()) cv::fillConvexPoly(picture, door, cv::Scalar(60, 90, 120), cv::LINE_AA);
  cv::Mat noise(picture.size(), CV_8UC3);
  cv::theRNG().state = 7;
  cv::randn(noise, cv::Scalar::all(8), cv::Scalar::all(4));
  return picture + noise;
}

TEST(DoorShape, ADoorOnAWallThatRunsAwayIsNoRectangle) {
  Points const door{{250, 80}, {380, 120}, {380, 400}, {252, 440}};
  auto const shape = door_shape(drawn(door), {250, 80, 130, 360});
  EXPECT_LT(farthest(shape.corners, door), 7.0);
  EXPECT_GT(shape.support, 0.8);
}

TEST(DoorShape, ABoxThatIsALittleWrongIsMendedByThePicture) {
  Points const door{{250, 80}, {380, 80}, {380, 440}, {250, 440}};
  auto const shape = door_shape(drawn(door), {238, 100, 150, 330});
  EXPECT_LT(farthest(shape.corners, door), 7.0);
}

TEST(DoorShape, ABareWallKeepsTheBoxAndSpeaksAgainstIt) {
  auto const shape = door_shape(drawn({}), {250, 80, 130, 360});
  EXPECT_LT(farthest(shape.corners, {{250, 80}, {380, 80}, {380, 440}, {250, 440}}), 0.5);
  EXPECT_LT(shape.support, 0.35);
}

TEST(DoorShape, WhatThePictureCutsOffEndsAtItsEdge) {
  Points const door{{-60, 60}, {70, 60}, {70, 520}, {-60, 520}};
  auto const shape = door_shape(drawn(door), {0, 60, 70, 420});
  EXPECT_LT(farthest(shape.corners, {{0, 60}, {70, 60}, {70, 480}, {0, 480}}), 7.0);
  EXPECT_GT(shape.support, 0.8);
}

TEST(DoorShape, PicturesOfAlmostNothingAreLeftAlone) {
  cv::Mat const speck(5, 5, CV_8UC3, cv::Scalar(1, 2, 3));
  EXPECT_EQ(door_shape(speck, {0, 0, 5, 5}).support, 0.0);
  EXPECT_EQ(door_shape(speck, {100, 100, 5, 5}).support, 0.0);
}

}  // namespace
}  // namespace lapwing::vision
