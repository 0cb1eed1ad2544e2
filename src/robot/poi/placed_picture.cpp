#include "robot/poi/placed_picture.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace lapwing::robot {

map::Picture placed_picture(CameraMount const& mount, vehicle::SitePose const& body) {
  double const cos = std::cos(body.yaw_rad);
  double const sin = std::sin(body.yaw_rad);
  double const yaw_rad = body.yaw_rad + mount.yaw_rad;
  // The camera's axes in the site: to the right, down, ahead.
  Eigen::Vector3d const right(std::sin(yaw_rad), -std::cos(yaw_rad), 0.0);
  Eigen::Vector3d const ahead(std::cos(mount.pitch_rad) * std::cos(yaw_rad),
                              std::cos(mount.pitch_rad) * std::sin(yaw_rad), std::sin(mount.pitch_rad));
  Eigen::Matrix3d turn;
  turn << right, ahead.cross(right), ahead;
  map::Picture picture;
  picture.position = {body.position.x() + mount.x_m * cos - mount.y_m * sin,
                      body.position.y() + mount.x_m * sin + mount.y_m * cos};
  picture.up_m = body.position.z() + mount.up_m;
  picture.site_from_camera = Eigen::Quaterniond(turn);
  return picture;
}

}  // namespace lapwing::robot
