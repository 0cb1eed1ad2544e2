#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "video/scene/projector.hpp"
#include "video/world/car_park.hpp"

namespace lapwing::video {

/// The ground from straight above, north up: surfaces, paint, and the shadows of what never moves.
struct GroundRaster {
  /// BGR; each has half the pixels a side of the one before, for whoever sees it from farther away.
  std::vector<cv::Mat> levels;
  cv::Mat shade;           ///< 8 bits: how much of it lies in such a shadow; of fewer pixels than the first level
  double pixel_m = 0.04;   ///< of the first level
  Spot north_west;         ///< the upper left corner of the first pixel
  cv::Scalar beyond = {};  ///< the ground round it

  /// How much of a place lies in the shadow of what never moves, 0 to 1.
  [[nodiscard]] double shade_at(Spot const& place) const;
};

/// More pixels are not drawn: a larger car park has coarser ones.
inline constexpr double most_ground_pixels = 30e6;

/// `photograph`: of the ground, where the car park has one; else empty.
[[nodiscard]] GroundRaster draw_ground(CarPark const& park, Sun const& sun, cv::Mat const& photograph);

}  // namespace lapwing::video
