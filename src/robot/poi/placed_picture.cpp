#include "robot/poi/placed_picture.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace lapwing::robot {

namespace {

map::Picture picture_after(MapMove const& moved, map::Picture picture) {
  auto const now = moved({picture.position, 0.0});
  picture.position = now.position;
  if (picture.site_from_camera)
    picture.site_from_camera =
        Eigen::Quaterniond(Eigen::AngleAxisd(now.yaw_rad, Eigen::Vector3d::UnitZ())) * *picture.site_from_camera;
  return picture;
}

}  // namespace

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

void move_pictures(map::LiveMap& live_map, std::vector<std::string>& ids, MapMove const& moved,
                   map::Account const& account) {
  std::erase_if(ids, [&](std::string const& id) {
    auto const* const record = live_map.find(map::LayerKind::pictures, id);
    if (!record || record->is_removed) return true;
    auto feature = record->feature;
    auto const before = std::get<map::Picture>(feature.content);
    auto now = picture_after(moved, before);
    if (now == before) return false;
    feature.account = account;
    feature.content = std::move(now);
    return !live_map.put(std::move(feature));
  });
}

}  // namespace lapwing::robot
