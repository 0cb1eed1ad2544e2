#include "vision/image/rectify.hpp"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

namespace lapwing::vision {

namespace {

constexpr int least_side = 8;

double length(cv::Point2f const& a, cv::Point2f const& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y);
}

}  // namespace

Quadrilateral in_order(std::array<cv::Point2f, 4> points) {
  cv::Point2f middle(0.0F, 0.0F);
  for (auto const& point : points) middle += point * 0.25F;
  // Clockwise on the screen, where y points down, from the one that is nearest to the upper left.
  std::ranges::sort(points, {}, [&](cv::Point2f const& p) { return std::atan2(p.y - middle.y, p.x - middle.x); });
  auto const first = std::ranges::min_element(points, {}, [](cv::Point2f const& p) { return p.x + p.y; });
  std::ranges::rotate(points, first);
  return points;
}

cv::Mat rectified(cv::Mat const& pixels, Quadrilateral const& corners, int longest) {
  double width = std::max(length(corners[0], corners[1]), length(corners[3], corners[2]));
  double height = std::max(length(corners[0], corners[3]), length(corners[1], corners[2]));
  double const shrink = std::min(1.0, longest / std::max({width, height, 1.0}));
  width = std::max<double>(least_side, std::round(width * shrink));
  height = std::max<double>(least_side, std::round(height * shrink));
  cv::Size const size(static_cast<int>(width), static_cast<int>(height));
  std::array<cv::Point2f, 4> const goal{cv::Point2f(0.0F, 0.0F), cv::Point2f(static_cast<float>(size.width), 0.0F),
                                        cv::Point2f(static_cast<float>(size.width), static_cast<float>(size.height)),
                                        cv::Point2f(0.0F, static_cast<float>(size.height))};
  cv::Mat out;
  cv::warpPerspective(pixels, out, cv::getPerspectiveTransform(corners.data(), goal.data()), size, cv::INTER_LINEAR,
                      cv::BORDER_REPLICATE);
  return out;
}

}  // namespace lapwing::vision
