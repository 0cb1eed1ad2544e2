#include "host/eyes/simulated_eyes.hpp"

#include <string>
#include <utility>

#include "host/eyes/picture_eyes.hpp"

namespace lapwing::host {

namespace {

namespace building = sim::building;

robot::CameraMount mount_of(building::CameraSettings const& settings) {
  return {.width_px = settings.width,
          .height_px = settings.height,
          .view_rad = settings.view_rad,
          .x_m = settings.x_m,
          .y_m = settings.y_m,
          .up_m = settings.up_m,
          .yaw_rad = settings.yaw_rad,
          .pitch_rad = settings.pitch_rad};
}

LookPicture developed(building::Shot const& shot) {
  auto const picture = building::develop(shot);
  return {.bytes = {picture.rgb.begin(), picture.rgb.end()}, .width = picture.width, .height = picture.height};
}

/// One camera of one robot.
struct Camera {
  building::Building* in;
  std::size_t robot;
  building::CameraSettings settings;
};

base::Task<base::Result<PictureSource::Develop>> shoot(Camera camera) {
  auto shot = camera.in->shoot(camera.robot, camera.settings);
  if (!shot) co_return base::fail(base::ErrorKind::lost, "the camera gives no picture");
  co_return PictureSource::Develop([shot = *std::move(shot)] { return developed(shot); });
}

PictureSource source_of(Camera const& camera) {
  return {.mount = mount_of(camera.settings), .take = [camera] { return shoot(camera); }};
}

}  // namespace

robot::Eyes simulated_eyes(base::Loop& loop, building::Building& in, std::size_t robot, LookingChild& child) {
  auto const& settings = in.robot(robot).settings();
  std::vector<PictureSource> for_tags;
  for (auto const& side : settings.side_cameras)
    for_tags.push_back(source_of({.in = &in, .robot = robot, .settings = side}));
  return eyes_with(loop, std::move(for_tags), source_of({.in = &in, .robot = robot, .settings = settings.camera}),
                   child);
}

}  // namespace lapwing::host
