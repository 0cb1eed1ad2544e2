#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/detection.hpp"
#include "vision/signs/sign_finder.hpp"

namespace lapwing::vision {

/// A door and the wall on both its sides, seen from the front, and the way back into the picture.
struct DoorView {
  cv::Mat pixels;
  cv::Matx33d to_picture;
};

/// `door` has corners; a view of less than 32 pixels a side shows nothing and is empty.
[[nodiscard]] DoorView view_of_door(cv::Mat const& pixels, Detection const& door);

/// What is written on a door and beside it, read from the front: signs on a wall that runs away are too slanted to be
/// found in the picture itself. In pixels of the picture.
[[nodiscard]] std::vector<Detection> signs_of_door(SignFinder& signs, cv::Mat const& pixels, Detection const& door);

}  // namespace lapwing::vision
