#pragma once

#include <array>

#include <opencv2/core.hpp>

namespace lapwing::vision {

/// Corners of something flat and rectangular as a picture shows it: upper left, upper right, lower right, lower left.
using Quadrilateral = std::array<cv::Point2f, 4>;

/// Four points in any order, as a quadrilateral.
[[nodiscard]] Quadrilateral in_order(std::array<cv::Point2f, 4> points);
/// Seen from the front. Its size is that of the longer of each two opposite sides, within 8 to `longest` pixels.
[[nodiscard]] cv::Mat rectified(cv::Mat const& pixels, Quadrilateral const& corners, int longest = 1600);

}  // namespace lapwing::vision
