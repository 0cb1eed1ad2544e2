#include "robot/poi/camera_mount.hpp"

#include <cmath>

#include "geo/position.hpp"

namespace lapwing::robot {

SightLine sight_line(CameraMount const& mount, vision::Point const& pixel) {
  double const focal_px = mount.width_px / 2.0 / std::tan(mount.view_rad / 2.0);
  double const left = (mount.width_px / 2.0 - pixel.x) / focal_px;
  double const above = (mount.height_px / 2.0 - pixel.y) / focal_px;
  double const ahead = std::cos(mount.pitch_rad) - above * std::sin(mount.pitch_rad);
  double const up = std::sin(mount.pitch_rad) + above * std::cos(mount.pitch_rad);
  return {.bearing_rad = geo::wrap_pi(mount.yaw_rad + std::atan2(left, ahead)), .slope = up / std::hypot(left, ahead)};
}

}  // namespace lapwing::robot
