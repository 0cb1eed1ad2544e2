#pragma once

#include <opencv2/core.hpp>

#include "explore/lot/lot_sight.hpp"
#include "geo/polygon.hpp"
#include "perceive/ground_picture.hpp"

namespace lapwing::perceive {

/// The ground of one picture in shades, north up, as coarse as is enough to lay it onto that of another picture.
struct GroundPlan {
  base::UtcTime at;
  map::SitePoint below;       ///< the camera
  map::SitePoint north_west;  ///< the outer corner of its first pixel
  double pixel_m = 0.0;    ///< 0.06, or twice or four times that and so on, so that no side has more than 512 of them
  cv::Mat shades = {};     ///< 8 bits
  cv::Mat is_seen = {};    ///< 255 where the picture shows it
  cv::Mat is_ground = {};  ///< 255 where, beside that, nothing stands
  /// From where its pose has it to where it lies beside the first picture, by what ties them: about the same for all
  /// pictures of a moment, and so where to look for what an older one shows.
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  /// Metres east and south.
  [[nodiscard]] cv::Rect2d box() const;
  [[nodiscard]] double shorter_side_m() const;
  [[nodiscard]] int in_pixels(double metres) const;
  /// Pixels to the right and down from the corner.
  [[nodiscard]] map::SitePoint place(cv::Point2d const& pixels) const;
};

/// `seen`: the ground that the picture shows well; `standing`: 255 where something stands, of the ground picture's
/// size.
[[nodiscard]] GroundPlan ground_plan(explore::LotSight const& sight, GroundPicture const& ground,
                                     geo::Polygon<geo::SiteFrame> const& seen, cv::Mat const& standing);

}  // namespace lapwing::perceive
