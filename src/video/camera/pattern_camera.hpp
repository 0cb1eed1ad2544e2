#pragma once

#include "video/camera/camera.hpp"

namespace lapwing::video {

/// A test pattern: bars of colour, the time as text, and a hand that goes round once a second. To see that pictures
/// arrive, in which order and how late, where there is no camera.
class PatternCamera final : public Camera {
 public:
  /// Precondition: the lens is sound.
  explicit PatternCamera(geo::Lens const& lens);

  [[nodiscard]] base::Result<Frame> take(Moment const& moment) override;
  [[nodiscard]] geo::Lens const& lens() const override { return lens_; }

 private:
  geo::Lens lens_;
  cv::Mat bars_;
};

}  // namespace lapwing::video
