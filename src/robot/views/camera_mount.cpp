#include "robot/views/camera_mount.hpp"

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

bool is_in_the_picture(CameraMount const& mount, double height_m, double range_m) {
  constexpr double margin_rad = 0.08;  // half of a sign's height
  double const focal_px = mount.width_px / 2.0 / std::tan(mount.view_rad / 2.0);
  double const half_rad = std::atan(mount.height_px / 2.0 / focal_px);
  double const above_rad = std::atan2(height_m - mount.up_m, range_m) - mount.pitch_rad;
  return std::abs(above_rad) < half_rad - margin_rad;
}

}  // namespace lapwing::robot
