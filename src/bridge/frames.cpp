#include "bridge/frames.hpp"

#include <cmath>
#include <numbers>

namespace lapwing::bridge {

bus::Point ros_point(geo::Ned place) {
  auto const enu = geo::to_enu(place);
  return {enu.east, enu.north, enu.up};
}

geo::Ned ned_from(bus::Point const& place) {
  return geo::to_ned({.east = place.x, .north = place.y, .up = place.z});
}

/// Of angles about z, then y, then x (Diebel 2006, Representing Attitude, equation 290).
bus::Quaternion ros_orientation(Attitude const& attitude) {
  double const roll = attitude.roll_rad / 2;
  double const pitch = -attitude.pitch_rad / 2;
  double const yaw = (std::numbers::pi / 2 - attitude.yaw_rad) / 2;
  double const cr = std::cos(roll), sr = std::sin(roll);
  double const cp = std::cos(pitch), sp = std::sin(pitch);
  double const cy = std::cos(yaw), sy = std::sin(yaw);
  return {.x = sr * cp * cy - cr * sp * sy,
          .y = cr * sp * cy + sr * cp * sy,
          .z = cr * cp * sy - sr * sp * cy,
          .w = cr * cp * cy + sr * sp * sy};
}

std::optional<double> heading_rad(bus::Quaternion const& orientation) {
  auto const& [x, y, z, w] = orientation;
  double const square = x * x + y * y + z * z + w * w;
  constexpr double least = 0.25;  // of a rotation it is one; messages round
  if (!std::isfinite(square) || square < least) return std::nullopt;
  double const yaw = std::atan2(2 * (w * z + x * y), square - 2 * (y * y + z * z));
  return geo::wrap_two_pi(std::numbers::pi / 2 - yaw);
}

}  // namespace lapwing::bridge
