#include "vision/cars/ground_scale.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {
namespace {

constexpr double car_length_m = 4.65;

/// White bars on black, each a car.
cv::Mat bars(double metres_a_pixel, int count) {
  auto const pixels = [&](double metres) { return static_cast<int>(std::lround(metres / metres_a_pixel)); };
  cv::Mat picture(pixels(30.0), pixels(44.0), CV_8UC3, cv::Scalar::all(0));
  for (int k = 0; k < count; ++k)
    cv::rectangle(picture, cv::Rect(pixels(4.0 + 6.0 * k), pixels(10.0), pixels(1.8), pixels(car_length_m)),
                  cv::Scalar::all(255), cv::FILLED);
  return picture;
}

/// What the network does, for bars: those of three quarters to four thirds of a car's length are seen, with their
/// length, the usual one most surely.
std::vector<SeenCar> see(cv::Mat const& square) {
  cv::Mat grey;
  cv::cvtColor(square, grey, cv::COLOR_BGR2GRAY);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(grey > 128, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  std::vector<SeenCar> cars;
  for (auto const& contour : contours) {
    auto const box = cv::boundingRect(contour);
    double const off = std::log(box.height / 46.5);
    if (std::abs(off) < 0.3)
      cars.push_back(
          {.box = {.middle = {}, .length = 1.0 * box.height, .width = 1.0 * box.width}, .score = std::exp(-off * off)});
  }
  return cars;
}

TEST(GroundScale, IsToldByHowLongVehiclesAre) {
  for (double const metres : {0.02, 0.03, 0.05, 0.1, 0.15}) {
    auto const told = metres_a_pixel_by_cars(bars(metres, 6), see);
    ASSERT_TRUE(told) << metres;
    EXPECT_NEAR(*told / metres, 1.0, 0.06) << metres;
  }
}

TEST(GroundScale, IsNotToldByNothing) {
  EXPECT_FALSE(metres_a_pixel_by_cars(bars(0.05, 0), see));
  EXPECT_FALSE(metres_a_pixel_by_cars(bars(0.05, 1), see));
  EXPECT_FALSE(metres_a_pixel_by_cars({}, see));
}

}  // namespace
}  // namespace lapwing::vision
