#include "vision/annotate.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

/// Told apart also by those who do not tell red from green: orange, blue, yellow and grey.
cv::Scalar colour_of(Detection const& detection) {
  constexpr double is_taken = 0.5;
  cv::Scalar const orange(0, 140, 255);
  cv::Scalar const blue(220, 120, 20);
  if (detection.category == "slot") {
    if (!detection.occupied_chance) return {150, 150, 150};
    return *detection.occupied_chance >= is_taken ? orange : blue;
  }
  if (detection.category == "car") return {0, 220, 255};
  return detection.category == "door" ? orange : blue;
}

std::string label_of(Detection const& detection) {
  auto label = fmt::format("{} {:.2f}", detection.category, detection.score);
  if (detection.text) label += " " + *detection.text;
  if (detection.kind) label += " " + *detection.kind;
  // OpenCV's own letters are ASCII; others would show as question marks each byte.
  std::ranges::replace_if(label, [](char c) { return c < ' ' || c > '~'; }, '?');
  return label;
}

/// Cars and slots are many and small: each is its outline and, for slots, the chance in percent.
void draw_on_ground(cv::Mat& drawn, Detection const& detection, double unit) {
  std::vector<cv::Point> corners;
  for (auto const& corner : *detection.corners)
    corners.emplace_back(static_cast<int>(std::lround(corner.x)), static_cast<int>(std::lround(corner.y)));
  constexpr bool is_closed = true;
  cv::polylines(drawn, corners, is_closed, colour_of(detection), std::max(1, static_cast<int>(1.5 * unit)),
                cv::LINE_AA);
  if (!detection.occupied_chance) return;
  auto const label = fmt::format("{:.0f}", 100.0 * *detection.occupied_chance);
  cv::Point const at(static_cast<int>(detection.box.x + 0.4 * detection.box.width),
                     static_cast<int>(detection.box.y + 0.6 * detection.box.height));
  cv::putText(drawn, label, at, cv::FONT_HERSHEY_SIMPLEX, 0.35 * unit, colour_of(detection), 1, cv::LINE_AA);
}

}  // namespace

cv::Mat annotated(cv::Mat const& pixels, std::span<Detection const> detections) {
  cv::Mat drawn = pixels.clone();
  // Lines and letters that can be read whatever the picture's size.
  double const unit = std::max(1.0, std::max(pixels.cols, pixels.rows) / 800.0);
  int const line = static_cast<int>(2.0 * unit);
  for (auto const& detection : detections) {
    if (detection.corners && (detection.category == "car" || detection.category == "slot")) {
      draw_on_ground(drawn, detection, unit);
      continue;
    }
    auto const& box = detection.box;
    cv::Rect const frame(cv::Point(static_cast<int>(box.x), static_cast<int>(box.y)),
                         cv::Size(static_cast<int>(box.width), static_cast<int>(box.height)));
    if (detection.corners) {
      std::vector<cv::Point> corners;
      for (auto const& corner : *detection.corners)
        corners.emplace_back(static_cast<int>(corner.x), static_cast<int>(corner.y));
      constexpr bool is_closed = true;
      cv::polylines(drawn, corners, is_closed, colour_of(detection), std::max(1, line / 2), cv::LINE_AA);
    }
    cv::rectangle(drawn, frame, colour_of(detection), line);
    int baseline = 0;
    auto const label = label_of(detection);
    auto const size = cv::getTextSize(label, cv::FONT_HERSHEY_SIMPLEX, 0.5 * unit, line / 2, &baseline);
    cv::Point const at(std::clamp(frame.x, 0, std::max(0, drawn.cols - size.width)),
                       std::max(frame.y - baseline, size.height + 1));
    cv::rectangle(drawn, {at.x, at.y - size.height, size.width, size.height + baseline}, colour_of(detection),
                  cv::FILLED);
    cv::putText(drawn, label, at, cv::FONT_HERSHEY_SIMPLEX, 0.5 * unit, {255, 255, 255}, line / 2, cv::LINE_AA);
  }
  return drawn;
}

}  // namespace lapwing::vision
