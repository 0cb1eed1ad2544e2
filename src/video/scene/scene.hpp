#pragma once

#include <vector>

#include "video/scene/ground_raster.hpp"
#include "video/scene/standing_things.hpp"
#include "video/world/car_park.hpp"

namespace lapwing::video {

/// The direction of each pixel, with z = 1: worked out once for a lens.
struct Rays {
  cv::Mat x;  ///< 32-bit numbers
  cv::Mat y;
};
/// Precondition: the lens is sound.
[[nodiscard]] Rays rays_of(geo::Lens const& lens);

/// A car park that is ready to be looked at. Its ground and its trees are drawn once.
class Scene {
 public:
  /// `photograph`: of the ground, where the car park has one; else empty.
  Scene(CarPark park, cv::Mat const& photograph);

  /// BGR, as a perfect camera would have it. The ground is level, at the height of the anchor; a camera that is not
  /// above it is taken to be `lowest_m` above. `rays` are those of the view's lens.
  [[nodiscard]] cv::Mat seen(geo::GroundView view, Rays const& rays, Occupation const& now) const;
  [[nodiscard]] CarPark const& park() const { return park_; }

  static constexpr double lowest_m = 0.05;

 private:
  [[nodiscard]] cv::Mat ground_seen(geo::GroundView const& view, Rays const& rays) const;
  void shadows(cv::Mat& picture, geo::GroundView const& view, std::vector<Vehicle const*> const& vehicles) const;
  void standing(cv::Mat& picture, geo::GroundView const& view, std::vector<Vehicle const*> const& vehicles) const;

  CarPark park_;
  Sun sun_;
  GroundRaster ground_;
  std::vector<Crown> crowns_;
};

}  // namespace lapwing::video
