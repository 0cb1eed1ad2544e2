#pragma once

#include <array>
#include <optional>

#include <opencv2/core.hpp>

#include "vision/cars/car_network.hpp"

namespace lapwing::vision {

/// The chance that a vehicle stands in a slot, whose corners are pixels of the picture: by the vehicles that were found
/// and by how much of the slot shows one. None where too little of the slot is in the picture to tell.
[[nodiscard]] std::optional<double> occupied_chance(std::array<cv::Point2d, 4> const& slot, Overhead const& seen,
                                                    cv::Size const& picture);

}  // namespace lapwing::vision
