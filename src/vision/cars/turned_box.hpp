#pragma once

#include <array>

#include <opencv2/core.hpp>

#include "vision/detection.hpp"

namespace lapwing::vision {

/// A rectangle on the ground as a picture from above shows it. Pixels; x to the right, y down.
struct TurnedBox {
  Point middle;
  double length = 0.0;
  double width = 0.0;
  double heading_rad = 0.0;  ///< of its length, from x towards y; a car's nose and tail are not told apart
};

/// In order round it.
[[nodiscard]] std::array<Point, 4> corners_of(TurnedBox const& box);
/// The upright box round it, within a picture of that size.
[[nodiscard]] Box upright_box(TurnedBox const& box, cv::Size const& picture);
[[nodiscard]] bool contains(TurnedBox const& box, Point const& point);

}  // namespace lapwing::vision
