#pragma once

#include <optional>

#include <opencv2/core.hpp>

#include "explore/lot/lot_settings.hpp"
#include "geo/camera/ground_view.hpp"
#include "map/features/geometry.hpp"

namespace lapwing::perceive {

/// The ground as it would be drawn on a plan: a pixel is everywhere as large, whatever the lens bends and however the
/// drone leans, so that who looks for paint and cars may count in metres.
struct GroundPicture {
  cv::Mat pixels;  ///< BGR; grey where the camera shows no ground well enough
  double metres_a_pixel = 0.0;
  map::SitePoint corner;  ///< the ground at the upper left corner of the picture
  Eigen::Vector2d right;  ///< on the ground, one metre
  Eigen::Vector2d down;

  /// `metres`: to the right and down from the corner.
  [[nodiscard]] map::SitePoint ground(cv::Point2d const& metres) const {
    return map::SitePoint(Eigen::Vector2d(corner.v + metres.x * right + metres.y * down));
  }
};

/// As finely as paint needs, and no finer. Nothing when the camera sees no ground well enough.
[[nodiscard]] std::optional<GroundPicture> ground_picture(cv::Mat const& picture, geo::GroundView const& view,
                                                          explore::LotSettings const& settings);

}  // namespace lapwing::perceive
