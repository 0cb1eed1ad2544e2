#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

#include "map/features/geometry.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "robot/views/camera_mount.hpp"

namespace lapwing::robot {

/// Where something is, and which way it looks, on a map that has moved; asked where it was before.
using MapMove = std::function<geo::Pose<geo::SiteFrame>(geo::Pose<geo::SiteFrame> const&)>;

/// How far from a robot nothing is in the way along the floor: towards a bearing on its body, at most so far.
using ClearWay = std::function<double(double bearing_rad, double most_m)>;

/// Where a wall is met, in the site's frame.
struct WallPoint {
  map::SitePoint position;
  double range_m = 0.0;     ///< along the floor, from the camera
  double facing_rad = 0.0;  ///< the way that the wall looks there: to the side that it is seen from
};

/// Where a body has its camera.
[[nodiscard]] map::SitePoint camera_place(geo::Pose<geo::SiteFrame> const& body, CameraMount const& mount);

/// A wall farther off shows a camera nothing that could be read or noticed.
inline constexpr double most_range_m = 5.0;
/// The first thing on a robot's map that a camera's line meets; nothing where what lies between is not known, or where
/// nothing is met within `most_m`.
[[nodiscard]] std::optional<WallPoint> wall_seen(map::OccupancyGrid const& grid, geo::Pose<geo::SiteFrame> const& body,
                                                 CameraMount const& mount, double bearing_rad,
                                                 double most_m = most_range_m);

/// Where a name tag hangs.
struct TagPlace {
  WallPoint wall;
  double height_m = 0.0;  ///< above the floor
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Zero();
};

/// Of a tag in a picture: by its direction and the wall that the map has there. Nothing where the map has none, or
/// where the tag would hang at a height at which nobody hangs one: then it is seen through a gap of the map.
[[nodiscard]] std::optional<TagPlace> tag_place(map::OccupancyGrid const& grid, geo::Pose<geo::SiteFrame> const& body,
                                                CameraMount const& mount, vision::Box const& tag);

}  // namespace lapwing::robot
