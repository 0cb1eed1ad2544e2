#pragma once

#include <opencv2/core.hpp>

#include "vision/detection.hpp"
#include "vision/image/rectify.hpp"

namespace lapwing::vision {

/// A door as a picture shows it: rarely upright and square.
struct DoorShape {
  Quadrilateral corners;
  /// 0 to 1: along how much of its two sides and its top the picture has an edge. A door has most of it; what is
  /// hidden or beyond the picture's edge says nothing for and nothing against.
  double support = 0.0;
};

/// The four lines that the picture has near a box's sides: each may be moved by a part of the box and be slanted as
/// perspective slants it. `pixels`: BGR, upright; `box` within it.
[[nodiscard]] DoorShape door_shape(cv::Mat const& pixels, Box const& box);

}  // namespace lapwing::vision
