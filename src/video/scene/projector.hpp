#pragma once

#include <optional>
#include <span>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "geo/camera/ground_view.hpp"

namespace lapwing::video {

/// The direction from which most light comes, and how much of it.
struct Sun {
  Eigen::Vector3d towards = {0.0, 0.0, 1.0};  ///< of unit length
  double share = 0.7;                         ///< of the light on level ground; the rest is the sky's
  double brightness = 1.0;

  /// How bright a face is drawn beside level ground: by the light that it gets, as pictures show light.
  [[nodiscard]] double on(Eigen::Vector3d const& normal) const;
  /// How bright what lies in a shadow is drawn, beside the same in the sun. `depth`: 0 in the sun, 1 in the shadow.
  [[nodiscard]] double in_shadow(double depth) const;
  /// Where the shadow of a point falls on level ground.
  [[nodiscard]] Eigen::Vector3d shadow_of(Eigen::Vector3d const& point) const;
};

/// Draws what stands on the ground into a picture, by the lens and the place of its camera.
class Projector {
 public:
  /// Both outlive it.
  Projector(geo::GroundView const& view, cv::Mat& picture);

  /// As OpenCV counts: the middle of the first pixel is (0, 0). Nothing for what is not ahead.
  [[nodiscard]] std::optional<cv::Point2d> pixel(Eigen::Vector3d const& point) const;
  /// Metres a pixel, square to the view, as far ahead as that point; 0 for what is not ahead.
  [[nodiscard]] double metres_a_pixel(Eigen::Vector3d const& point) const;
  [[nodiscard]] Eigen::Vector3d const& camera() const { return camera_; }
  /// Whether something of that size round it may be in the picture.
  [[nodiscard]] bool may_show(Eigen::Vector3d const& middle, double radius_m) const;

  /// Left out where a corner is not ahead. `is_convex` is faster.
  void fill(std::span<Eigen::Vector3d const> corners, cv::Scalar const& colour, bool is_convex = true) const;
  void disc(Eigen::Vector3d const& middle, double radius_m, cv::Scalar const& colour) const;

 private:
  geo::Lens const& lens_;
  cv::Mat& picture_;
  Eigen::Matrix3d camera_from_site_;
  Eigen::Vector3d camera_;
};

}  // namespace lapwing::video
