#pragma once

#include <span>

#include <Eigen/Core>

#include "explore/lot/lot_sight.hpp"

namespace lapwing::explore {

/// How a picture lies on the map, other than its camera's pose says: moved, turned and stretched about the ground below
/// the camera. A pose that is off by little does that to the ground of a picture from above: level error moves it, and
/// so does a tilt; an error of heading turns it, one of height stretches it.
struct PictureShift {
  Eigen::Vector4d v = Eigen::Vector4d::Zero();  ///< east and north in metres, radians counterclockwise, share of length

  /// Where it is what the picture had at `place`; `below`: the ground below the camera, as its pose says.
  [[nodiscard]] map::SitePoint of(map::SitePoint const& place, map::SitePoint const& below) const;
};

/// The ground below the camera.
[[nodiscard]] map::SitePoint below_camera(LotSight const& sight);

/// The picture as it lies on the map: the camera's place, and all that was found.
[[nodiscard]] LotSight shifted(LotSight sight, PictureShift const& shift);

/// By how much each part of a shift may be expected, a standard deviation each.
[[nodiscard]] Eigen::Vector4d expected_shift(LotSight const& sight);

/// What a shift does to a place that lies `from_below` away: the partial derivatives of `PictureShift::of`, which is
/// linear.
[[nodiscard]] Eigen::Matrix<double, 2, 4> shift_of_place(Eigen::Vector2d const& from_below);

/// A place of the picture that is known on the map.
struct Tie {
  map::SitePoint in_picture;
  map::SitePoint on_map;
  double sigma_m = 0.0;
};

struct FittedShift {
  PictureShift shift;
  Eigen::Vector4d sigma;  ///< of each of its parts, that is left
};
/// The shift that brings a picture's places nearest to where they are on the map, by least squares with what may be
/// expected of its camera; a tie that does not fit counts less (Huber 1964).
[[nodiscard]] FittedShift fitted_shift(LotSight const& sight, std::span<Tie const> ties);

/// The share of its weight that Huber's loss leaves to a residual of so many standard deviations.
[[nodiscard]] double huber_share(double sigmas);

}  // namespace lapwing::explore
