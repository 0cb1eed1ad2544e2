#pragma once

#include <cstdint>

#include <opencv2/core.hpp>

#include "video/world/car_park.hpp"

/// What the ground is made of, pixel by pixel. For ground_raster.cpp.
namespace lapwing::video {

/// From metres to the pixels of the raster's first level.
struct RasterFrame {
  Spot north_west;
  double pixel_m = 0.04;
  cv::Size size;

  [[nodiscard]] cv::Point2d pixel(Spot const& place) const {
    return {(place.x() - north_west.x()) / pixel_m, (north_west.y() - place.y()) / pixel_m};
  }
};

/// Smooth noise with a middle of 128 and a spread of some 40, of several sizes at once: ground is nowhere all alike.
[[nodiscard]] cv::Mat clouds(cv::Size size, double pixel_m, std::uint64_t seed);
/// The same for each pixel by itself; repeated over the raster.
[[nodiscard]] cv::Mat grain(std::uint64_t seed);

/// BGR. Cracks, mended places and stains come with wear.
[[nodiscard]] cv::Mat draw_surface(CarPark const& park, RasterFrame const& frame, cv::Mat const& clouds,
                                   cv::Mat const& grain);
/// Lines of paint, worn away in part.
void draw_paint(cv::Mat& ground, CarPark const& park, RasterFrame const& frame, cv::Mat const& clouds,
                cv::Mat const& grain);

/// Filled, each value of `mask` to 255.
void fill_mask(cv::Mat& mask, std::vector<cv::Point2d> const& corners, double value = 255.0);
[[nodiscard]] cv::Scalar mean_grass();

}  // namespace lapwing::video
