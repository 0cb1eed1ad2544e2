#pragma once

#include <vector>

#include "map/grid/occupancy_grid.hpp"
#include "robot/views/camera_mount.hpp"
#include "robot/views/tag_place.hpp"

namespace lapwing::robot {

/// Where name tags hang, above the floor: of most, the lower edge and the upper one.
inline constexpr double low_tag_m = 1.2;
inline constexpr double high_tag_m = 1.5;

/// A piece of wall that a picture shows.
struct SeenWall {
  WallPoint wall;
  double clearness = 0.0;  ///< see `clearness`; less where the picture's edge may cut a tag off
};

/// The walls in the picture that a camera would take from there, by the robot's map: those from which letters can be
/// told, or that something is written there.
[[nodiscard]] std::vector<SeenWall> walls_in_picture(map::OccupancyGrid const& grid, CameraMount const& mount,
                                                     geo::Pose<geo::SiteFrame> const& body);

/// Near enough, and not too much aslant, for what is written there to be believed. `way_rad`: the line of sight's.
[[nodiscard]] bool is_readable(WallPoint const& wall, double way_rad);

/// The walls round a robot, in sight of it whichever way its cameras look.
[[nodiscard]] std::vector<WallPoint> walls_round(map::OccupancyGrid const& grid, geo::Pose<geo::SiteFrame> const& body);

}  // namespace lapwing::robot
