#pragma once

#include <span>

#include <opencv2/core.hpp>

#include "vision/detection.hpp"

namespace lapwing::vision {

/// The picture (BGR) with a frame round each detection, and what it is beside it.
[[nodiscard]] cv::Mat annotated(cv::Mat const& pixels, std::span<Detection const> detections);

}  // namespace lapwing::vision
