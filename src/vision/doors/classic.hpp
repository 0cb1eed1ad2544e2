#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/detection.hpp"

namespace lapwing::vision {

/// Doors by their colour: the plain way, for buildings whose doors all have one that the walls have not.
struct DoorColour {
  /// Hue in half degrees (0 to 179), saturation and value (0 to 255), as OpenCV counts them. The default is wood and
  /// brown paint. A hue that ends below its beginning goes over red.
  cv::Vec3i lowest{5, 60, 40};
  cv::Vec3i highest{25, 255, 230};
};

/// A threshold in HSV, the contours of what is left, and the area of each by its moments: what is large enough and
/// fills an upright box is a door. `pixels`: BGR, upright.
[[nodiscard]] std::vector<Detection> doors_by_colour(cv::Mat const& pixels, DoorColour const& colour = {});

}  // namespace lapwing::vision
