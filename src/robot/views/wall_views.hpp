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
  double way_m = 0.0;      ///< there, roughly
  bool is_likely = false;  ///< most likely there is a sign: it shows something, or a doorway is beside it
};

/// Where a robot looks next at walls that no camera of it has seen well enough, from `here`: at those on which there is
/// most likely a sign, from near, until they are clear; and at others on which no camera would have noticed one, from
/// where much is seen at once. It is the view that is worth most for its way. Nothing when there is none that it can
/// get to.
[[nodiscard]] std::optional<WallView> next_wall_view(LookBook const& looks, map::OccupancyGrid const& grid,
                                                     std::span<CameraMount const> mounts, map::SitePoint const& here);

}  // namespace lapwing::robot
