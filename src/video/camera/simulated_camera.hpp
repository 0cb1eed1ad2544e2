#pragma once

#include <deque>

#include "video/camera/camera.hpp"
#include "video/scene/scene.hpp"

namespace lapwing::video {

/// A camera over a simulated car park. The same world, settings and moments give the same pictures.
class SimulatedCamera final : public Camera {
 public:
  /// Precondition: the settings are sound. `photograph`: of the ground, where the car park has one.
  SimulatedCamera(CameraSettings settings, CarPark park, cv::Mat const& photograph);

  [[nodiscard]] base::Result<Frame> take(Moment const& moment) override;
  [[nodiscard]] geo::Lens const& lens() const override { return settings_.lens; }
  [[nodiscard]] CarPark const& park() const { return scene_.park(); }

 private:
  /// Where the camera was when the light fell in of the picture that can be had now.
  [[nodiscard]] Moment exposed(Moment const& asked);
  [[nodiscard]] geo::CameraPlace disturbed(Moment const& moment) const;
  void spoil(cv::Mat& picture, base::UtcTime at) const;

  CameraSettings settings_;
  geo::Vector3<geo::SiteFrame> world_from_told_;  ///< from the poses' frame to the world's
  Scene scene_;
  Rays rays_;
  cv::Mat noise_;  ///< with 128 as its middle; larger than a picture, so that each has another part
  std::deque<Moment> moments_;
};

}  // namespace lapwing::video
