#pragma once

#include <array>
#include <span>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/cars/car_answer.hpp"
#include "vision/lot/seen_ground.hpp"

namespace lapwing::vision {

/// A place to park in a picture.
struct SeenSlot {
  std::array<cv::Point2d, 4> corners;  ///< pixels, in order round it
  double surety = 1.0;                 ///< as of SlotShape
};

/// The slots of a picture from straight above: between the paint on the ground and the cars that were found. `seen`:
/// what of it was really seen.
[[nodiscard]] std::vector<SeenSlot> slots_seen(cv::Mat const& pixels, std::span<SeenCar const> cars,
                                               double metres_a_pixel, SeenGround const& seen);
/// All of it was.
[[nodiscard]] std::vector<SeenSlot> slots_seen(cv::Mat const& pixels, std::span<SeenCar const> cars,
                                               double metres_a_pixel);

}  // namespace lapwing::vision
