#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "geo/camera/lens.hpp"
#include "geo/polygon.hpp"
#include "geo/site.hpp"
#include "geo/transform.hpp"

/// What of the ground a camera sees: from pixels to places and back, by where it is, how it looks and how high the
/// ground is.
namespace lapwing::geo {

/// Where a camera is and which way it looks.
using CameraPlace = Transform3<SiteFrame, CameraFrame>;

/// `yaw_rad`: where the upper edge of the picture points, seen from above, counterclockwise from east; for a camera
/// that looks aside that is where it looks. `tilt_rad`: 0 looks straight down, pi/2 at the horizon. `roll_rad`: turns
/// the camera clockwise about the direction in which it looks.
[[nodiscard]] CameraPlace camera_at(Point3<SiteFrame> const& position, double yaw_rad, double tilt_rad,
                                    double roll_rad = 0.0);

/// A camera over level ground.
struct GroundView {
  Lens lens;
  CameraPlace site_from_camera = {};
  double ground_up_m = 0.0;  ///< above the site's anchor

  [[nodiscard]] double height_m() const { return site_from_camera.origin().z() - ground_up_m; }
};

/// Nothing where a pixel shows the sky, and where the camera is not above the ground.
[[nodiscard]] std::optional<Point<SiteFrame>> ground_at(GroundView const& view, Pixel const& pixel);

/// How high the ground is above the site's anchor, metres.
using GroundHeight = std::function<double(Point<SiteFrame> const&)>;
/// The first ground that a pixel shows where it is not level; `view.ground_up_m` does not count. Followed in steps of
/// `step_m` along the ray, so that a ridge narrower than that may be looked through, up to `farthest_m` from the
/// camera.
[[nodiscard]] std::optional<Point3<SiteFrame>> ground_at(GroundView const& view, Pixel const& pixel,
                                                         GroundHeight const& ground, double farthest_m = 500.0,
                                                         double step_m = 0.5);

/// Where a place on the ground is drawn; nothing when that is outside of the picture.
[[nodiscard]] std::optional<Pixel> seen_at(GroundView const& view, Point<SiteFrame> const& ground);

/// The ground that the corners show, from the upper left one clockwise in the picture: nothing where the horizon is in
/// the picture. What a picture on the map has as its footprint.
[[nodiscard]] std::optional<std::array<Point<SiteFrame>, 4>> footprint_corners(GroundView const& view);

/// The outline of all ground that is seen and less than `farthest_m` away from below the camera: sides that the lens
/// bends are bent, and above the horizon it is cut off. Empty when nothing of it is seen.
[[nodiscard]] Ring<SiteFrame> footprint(GroundView const& view, double farthest_m);

/// What a pixel measures on the ground, metres: along the direction in which it measures least, and most. Looking
/// straight down the two are the same.
struct GroundSampling {
  double finest_m = 0.0;
  double coarsest_m = 0.0;
};
/// Nothing where the pixel shows the sky.
[[nodiscard]] std::optional<GroundSampling> ground_sampling(GroundView const& view, Pixel const& pixel);

}  // namespace lapwing::geo
