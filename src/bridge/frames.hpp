#pragma once

#include <optional>

#include "bus/messages/common.hpp"
#include "geo/position.hpp"

/// From MAVLink's frames to those of ROS and back. MAVLink: the world north, east, down; the body ahead, right, down.
/// ROS (REP 103, REP 105): the world east, north, up; the body ahead, left, up.
///
/// A rotation R of the body in the one world is C R B in the other, with C = (0 1 0; 1 0 0; 0 0 -1) and B = diag(1, -1,
/// -1), as MAVROS has it (its NED_ENU and AIRCRAFT_BASELINK rotations). For roll, pitch and yaw that comes to roll,
/// -pitch and pi/2 - yaw.
namespace lapwing::bridge {

[[nodiscard]] bus::Point ros_point(geo::Ned place);
[[nodiscard]] geo::Ned ned_from(bus::Point const& place);

/// Angles as MAVLink has them: about the body's axes, yaw clockwise from north.
struct Attitude {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};
[[nodiscard]] bus::Quaternion ros_orientation(Attitude const& attitude);

/// Clockwise from north, in [0, 2 pi). Nothing for what is no rotation: zeros, by which somebody says that the heading
/// does not matter, or no numbers.
[[nodiscard]] std::optional<double> heading_rad(bus::Quaternion const& orientation);

}  // namespace lapwing::bridge
