#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "explore/path/motion.hpp"
#include "geo/point.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::robot {

/// Of the robot's own map: it begins where the robot does, looking along x.
using Place = geo::Point<map::GridFrame>;

/// What a carrier is asked to do.
struct Motion {
  double speed_m_s = 0.0;
  double turn_rad_s = 0.0;
  friend bool operator==(Motion const&, Motion const&) = default;
};

/// How large the robot is, what it can do and what it keeps off.
using Limits = explore::CarrierLimits;
/// Nobody drives a larger one between walls.
inline constexpr double most_radius_m = 1.0;

/// Where to go next: along points, or by a heading.
struct Way {
  std::vector<Place> points = {};  ///< from where it was planned; empty: stand, unless there is a heading
  /// The farthest point to which the straight way from where it was planned is free: who aims farther cuts corners.
  std::size_t clear_to = std::numeric_limits<std::size_t>::max();
  bool is_to_the_end = false;  ///< the last point is the goal; else the way goes on behind it
  std::optional<double> yaw_rad = {};
  double speed_m_s = 0.0;
  double turn_rad_s = std::numeric_limits<double>::infinity();  ///< at most
};

}  // namespace lapwing::robot
