#pragma once

#include <optional>
#include <span>

#include "robot/views/look_book.hpp"
#include "robot/views/viewpoint.hpp"

namespace lapwing::robot {

/// A wall that is to be looked at, and from where.
struct WallView {
  WallPiece piece;
  Viewpoint view;
};

/// Where a robot looks next, from `here`: at the nearest wall on which something was noticed that is not read, however
/// far off; when there is none, at walls on which no camera of it would have noticed a sign. Of these it is the view
/// that is worth most for its way: beside doorways from near, at others from where much is seen at once. Nothing when
/// there is none that it can get to. `which`: of which walls at all.
[[nodiscard]] std::optional<WallView> next_wall_view(LookBook const& looks, map::OccupancyGrid const& grid,
                                                     std::span<CameraMount const> mounts, map::SitePoint const& here,
                                                     WallChoice which = WallChoice::any);

}  // namespace lapwing::robot
