#include "vision/doors/classic.hpp"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// Doors are large; a small picture shows them as well, and in a tenth of the time.
constexpr int working_side = 640;
/// Of the picture. A robot takes doors from 2 m or less, where one fills far more.
constexpr double least_area = 0.02;
/// Of its box: handles, windows and perspective take some of a door away.
constexpr double least_filling = 0.55;
/// Height to width, cut off or seen from the side.
constexpr double least_slenderness = 1.0;
constexpr double most_slenderness = 6.0;

cv::Mat mask_of(cv::Mat const& pixels, DoorColour const& colour) {
  cv::Mat hsv;
  cv::cvtColor(pixels, hsv, cv::COLOR_BGR2HSV);
  cv::Mat mask;
  auto const low = cv::Scalar(colour.lowest[0], colour.lowest[1], colour.lowest[2]);
  auto const high = cv::Scalar(colour.highest[0], colour.highest[1], colour.highest[2]);
  if (colour.lowest[0] <= colour.highest[0]) {
    cv::inRange(hsv, low, high, mask);
  } else {
    cv::Mat before_red;
    constexpr double last_hue = 179.0;
    cv::inRange(hsv, low, cv::Scalar(last_hue, high[1], high[2]), before_red);
    cv::inRange(hsv, cv::Scalar(0, low[1], low[2]), high, mask);
    mask |= before_red;
  }
  // Grain and specks away, then small holes closed.
  auto const small = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  auto const large = cv::getStructuringElement(cv::MORPH_RECT, {9, 9});
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, small);
  cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, large);
  return mask;
}

}  // namespace

std::vector<Detection> doors_by_colour(cv::Mat const& pixels, DoorColour const& colour) {
  if (pixels.empty()) return {};
  double const scale = std::min(1.0, static_cast<double>(working_side) / std::max(pixels.cols, pixels.rows));
  cv::Size const size(std::max(1, static_cast<int>(pixels.cols * scale)),
                      std::max(1, static_cast<int>(pixels.rows * scale)));
  cv::Mat small;
  cv::resize(pixels, small, size, 0.0, 0.0, cv::INTER_AREA);
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask_of(small, colour), contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_SIMPLE);
  std::vector<Detection> doors;
  double const x_scale = static_cast<double>(pixels.cols) / size.width;
  double const y_scale = static_cast<double>(pixels.rows) / size.height;
  for (auto const& contour : contours) {
    double const area = cv::moments(contour).m00;
    auto const box = cv::boundingRect(contour);
    double const filling = area / box.area();
    double const slenderness = static_cast<double>(box.height) / box.width;
    if (area < least_area * size.area() || filling < least_filling) continue;
    if (slenderness < least_slenderness || slenderness > most_slenderness) continue;
    doors.push_back({.category = "door",
                     .box = {.x = box.x * x_scale,
                             .y = box.y * y_scale,
                             .width = box.width * x_scale,
                             .height = box.height * y_scale},
                     .score = std::min(1.0, filling)});
  }
  std::ranges::stable_sort(doors, std::ranges::greater(), &Detection::score);
  return doors;
}

}  // namespace lapwing::vision
