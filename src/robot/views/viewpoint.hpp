#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "map/features/geometry.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "robot/views/camera_mount.hpp"

namespace lapwing::robot {

/// Where a robot is to stand, and how, so that one of its cameras looks at a place on a wall.
struct Viewpoint {
  map::SitePoint from;       ///< the robot's middle
  map::SitePoint at;         ///< what is looked at
  std::size_t eye = 0;       ///< which camera
  double bearing_rad = 0.0;  ///< on the body, that it looks along: counterclockwise from straight ahead
};

/// Which walls a camera is to look at.
enum class WallChoice {
  any,
  likely,  ///< where most likely a sign is: something was noticed there, or a doorway is beside it
};

/// Something on a wall.
struct OnWall {
  map::SitePoint position;
  double height_m = 0.0;
  double facing_rad = 0.0;
};

/// That the wall there is as wide as a sign: not the edge of a door, nor a leg of something.
[[nodiscard]] bool is_wide_enough(OnWall const& what, map::OccupancyGrid const& grid);

/// That the wall has an opening as wide as a doorway near by, and goes on behind it: there signs hang first of all.
[[nodiscard]] bool is_beside_an_opening(OnWall const& what, map::OccupancyGrid const& grid);

/// From where it is seen squarely and from near, the best first: where the map is free for the robot and nothing stands
/// between. None where there is no such place, or no camera has it in its picture from there.
[[nodiscard]] std::vector<Viewpoint> viewpoints_for(OnWall const& what, map::OccupancyGrid const& grid,
                                                    std::span<CameraMount const> mounts);

}  // namespace lapwing::robot
