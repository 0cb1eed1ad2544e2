#include "vision/cars/contrast_cars.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

/// Asphalt of 40 by 30 m with two cars on it, of which one lies aslant, and a line of paint.
cv::Mat asphalt(double metres_a_pixel) {
  auto const pixels = [&](double metres) { return static_cast<int>(std::lround(metres / metres_a_pixel)); };
  cv::Mat picture(pixels(30.0), pixels(40.0), CV_8UC3, cv::Scalar(96, 98, 100));
  cv::line(picture, {0, pixels(15.0)}, {pixels(40.0), pixels(15.0)}, {230, 230, 230}, pixels(0.12));
  auto const car = [&](double x, double y, float degrees, cv::Scalar const& paint) {
    cv::Point2f corners[4];
    cv::RotatedRect({static_cast<float>(pixels(x)), static_cast<float>(pixels(y))},
                    {static_cast<float>(pixels(4.6)), static_cast<float>(pixels(1.8))}, degrees)
        .points(corners);
    std::vector<cv::Point> outline(corners, corners + 4);
    cv::fillConvexPoly(picture, outline, paint);
  };
  car(10.0, 8.0, 0.0F, {240, 240, 240});
  car(28.0, 22.0, 30.0F, {30, 30, 170});
  return picture;
}

TEST(ContrastCars, AreFoundAtAnyScale) {
  for (double const metres : {0.05, 0.1, 0.13}) {
    auto const cars = cars_by_contrast(asphalt(metres), metres);
    ASSERT_EQ(cars.size(), 2U) << metres;
    bool const first_is_white = cars[0].box.middle.x * metres < 20.0;
    auto const& white = cars[first_is_white ? 0 : 1].box;
    auto const& red = cars[first_is_white ? 1 : 0].box;
    EXPECT_NEAR(white.middle.x * metres, 10.0, 0.3);
    EXPECT_NEAR(white.length * metres, 4.6, 0.5);
    EXPECT_NEAR(std::abs(std::sin(white.heading_rad)), 0.0, 0.1);
    EXPECT_NEAR(red.middle.y * metres, 22.0, 0.3);
    EXPECT_NEAR(std::abs(std::sin(red.heading_rad)), 0.5, 0.1);
  }
}

TEST(ContrastCars, WhatIsLargerOrSmallerIsNone) {
  // The same picture, told to be of another scale: cars of 15 m, and of 1 m.
  EXPECT_TRUE(cars_by_contrast(asphalt(0.05), 0.16).empty());
  EXPECT_TRUE(cars_by_contrast(asphalt(0.05), 0.011).empty());
  EXPECT_TRUE(cars_by_contrast({}, 0.05).empty());
  EXPECT_TRUE(cars_by_contrast(cv::Mat(1, 4000, CV_8UC3, cv::Scalar::all(90)), 0.05).empty());
}

}  // namespace
}  // namespace lapwing::vision
