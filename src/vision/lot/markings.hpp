#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace lapwing::vision {

/// A straight line of paint on the ground: the middle of its width. Metres from the upper left corner of the picture, x
/// to the right, y down.
struct PaintedLine {
  cv::Point2d from;
  cv::Point2d to;

  [[nodiscard]] double length() const { return cv::norm(to - from); }
};

/// Bright lines as wide as paint is, and longer than a metre: whatever is brighter than the ground on both of its
/// sides. Some are no paint: edges of roofs and kerbs are among them.
[[nodiscard]] std::vector<PaintedLine> painted_lines(cv::Mat const& pixels, double metres_a_pixel);

}  // namespace lapwing::vision
