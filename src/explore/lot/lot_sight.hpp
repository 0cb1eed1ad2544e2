#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "geo/camera/ground_view.hpp"
#include "map/features/geometry.hpp"

/// What one picture tells of a car park, on the ground.
namespace lapwing::explore {

/// Corners in order round it.
using Corners = std::array<map::SitePoint, 4>;

/// A place to park, as it was found in the picture.
struct SlotSight {
  Corners outline;
  double surety = 0.0;                      ///< the chance that there is one
  std::optional<double> taken_chance = {};  ///< nothing where it is not seen well enough to tell
};

/// A vehicle, as it was found in the picture.
struct CarSight {
  Corners outline;
  double chance = 0.0;  ///< that there is one
};

/// A place on the ground that an earlier picture of the same vehicle shows, too: a tie point. However far off both
/// poses are, it is the same place.
struct TiePoint {
  base::UtcTime earlier;  ///< when that picture was taken
  map::SitePoint here;    ///< as this picture's pose has it
  map::SitePoint there;   ///< as the earlier one's pose has it
  double sigma_m = 0.0;   ///< of what the two pictures may be laid onto each other wrongly
};

/// How far the camera may be from where it says that it is: standard deviations.
struct PoseDoubt {
  double position_m = 0.3;    ///< level, beside what all pictures have in common
  double angle_rad = 0.008;   ///< of its tilt and roll
  double heading_rad = 0.02;  ///< a compass errs by more
  double height_m = 0.3;      ///< above the ground
};

/// A picture's account.
struct LotSight {
  std::string vehicle;
  base::UtcTime at;
  geo::GroundView view;
  PoseDoubt doubt = {};
  std::vector<SlotSight> slots = {};
  std::vector<CarSight> cars = {};
  std::vector<TiePoint> tie_points = {};
  bool ties_later = false;  ///< later pictures may have tie points with it
};

/// Pixels on the ground, by where the camera was; nothing where one of them shows the sky or lies more than
/// `farthest_m` from below the camera.
[[nodiscard]] std::optional<Corners> on_ground(geo::GroundView const& view, std::array<geo::Pixel, 4> const& corners,
                                               double farthest_m = 200.0);

/// By how much a place on the ground is off: the position's doubt, and at height h and distance d that of tilt and
/// roll, (h^2 + d^2) / h for each radian along, which is more than across; of the heading, d; and of the height, d / h
/// for each metre.
[[nodiscard]] double ground_doubt_m(LotSight const& sight, map::SitePoint const& ground);

[[nodiscard]] map::SitePoint middle_of(Corners const& corners);
/// Of the two kinds of sides, on average: the shorter and the longer.
struct Sides {
  double width_m = 0.0;
  double length_m = 0.0;
};
[[nodiscard]] Sides sides_of(Corners const& corners);
/// Along its longer sides, in [0, pi).
[[nodiscard]] double axis_of(Corners const& corners);
/// Between axes, in [0, pi / 2].
[[nodiscard]] double between_axes(double a_rad, double b_rad);
/// Positive inside of a convex outline, negative outside: metres to the nearest side's line.
[[nodiscard]] double inside_by_m(Corners const& corners, map::SitePoint const& place);
/// The corners in that order round (or the other way) which lies nearest to those of `like`.
[[nodiscard]] Corners aligned(Corners const& corners, Corners const& like);

}  // namespace lapwing::explore
