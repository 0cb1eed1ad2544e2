#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "vision/cars/car_answer.hpp"

namespace lapwing::vision {

/// Vehicles by their contrast: the plain way, for asphalt of one colour with little on it. What differs from the ground
/// in brightness or colour and is as large as a vehicle is one; of cars that touch in the picture it makes none or one.
[[nodiscard]] std::vector<SeenCar> cars_by_contrast(cv::Mat const& pixels, double metres_a_pixel);

}  // namespace lapwing::vision
