#include "vision/cars/contrast_cars.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// From the shortest car to the longest van, in metres.
constexpr double shortest = 3.2;
constexpr double longest = 7.0;
constexpr double narrowest = 1.3;
constexpr double widest = 2.7;

/// How far each pixel is from the ground's colour, which is the middle one of what surrounds it: 0 to 255.
cv::Mat strangeness(cv::Mat const& pixels) {
  cv::Mat lab;
  cv::cvtColor(pixels, lab, cv::COLOR_BGR2Lab);
  // A median over more than a car's length; at a quarter of the size it is as good and quick.
  cv::Mat small;
  cv::resize(lab, small, {}, 0.25, 0.25, cv::INTER_AREA);
  constexpr int around = 41;
  cv::Mat ground;
  cv::medianBlur(small, ground, around);
  cv::resize(ground, ground, lab.size());
  cv::Mat difference;
  cv::absdiff(lab, ground, difference);
  cv::Mat channels[3];
  cv::split(difference, channels);
  cv::Mat all;
  constexpr double of_colour = 2.0;  // a little colour tells more than a little light
  cv::addWeighted(channels[1], of_colour, channels[2], of_colour, 0.0, all);
  cv::max(all, channels[0], all);
  return all;
}

/// A blob as a vehicle, if it has the size of one.
std::optional<SeenCar> car_of(std::vector<cv::Point> const& contour) {
  auto const turned = cv::minAreaRect(contour);
  bool const is_lengthwise = turned.size.width >= turned.size.height;
  double const length = std::max(turned.size.width, turned.size.height);
  double const width = std::min(turned.size.width, turned.size.height);
  if (length < shortest / car_metres || length > longest / car_metres || width < narrowest / car_metres ||
      width > widest / car_metres)
    return std::nullopt;
  double const fill = cv::contourArea(contour) / (length * width);
  constexpr double least_fill = 0.6;
  if (fill < least_fill) return std::nullopt;
  double const degrees = turned.angle + (is_lengthwise ? 0.0 : 90.0);
  return SeenCar{.box = {.middle = {turned.center.x, turned.center.y},
                         .length = length,
                         .width = width,
                         .heading_rad = degrees * std::numbers::pi / 180.0},
                 .score = std::min(1.0, fill)};
}

}  // namespace

std::vector<SeenCar> cars_by_contrast(cv::Mat const& pixels, double metres_a_pixel) {
  if (pixels.empty()) return {};
  double const scale = metres_a_pixel / car_metres;
  cv::Size const size(static_cast<int>(std::lround(pixels.cols * scale)),
                      static_cast<int>(std::lround(pixels.rows * scale)));
  constexpr int least_side = 16;  // less is smaller than a car
  if (std::min(size.width, size.height) < least_side) return {};
  cv::Mat scaled;
  cv::resize(pixels, scaled, size, 0.0, 0.0, scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  cv::Mat mask;
  constexpr double is_strange = 34.0;
  cv::threshold(strangeness(scaled), mask, is_strange, 255, cv::THRESH_BINARY);
  // Lines of paint are 1 or 2 pixels wide and go; panes and roof of one car join.
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {7, 7}));
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<SeenCar> cars;
  for (auto const& contour : contours) {
    auto car = car_of(contour);
    if (!car) continue;
    car->box.middle = {car->box.middle.x / scale, car->box.middle.y / scale};
    car->box.length /= scale;
    car->box.width /= scale;
    cars.push_back(*car);
  }
  return each_once(std::move(cars));
}

}  // namespace lapwing::vision
