#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/cars/car_answer.hpp"

namespace lapwing::vision {

/// The vehicles of a square of `car_input` pixels at most, as CarNetwork::look_at_square tells them.
using SquareLook = std::function<std::vector<SeenCar>(cv::Mat const& square)>;

/// What a pixel measures on the ground, in metres, as the vehicles in the picture tell: looked for at every scale, the
/// right one is where most of them are as long as vehicles are. None where too few are seen to tell.
[[nodiscard]] std::optional<double> metres_a_pixel_by_cars(cv::Mat const& pixels, SquareLook const& look);

}  // namespace lapwing::vision
