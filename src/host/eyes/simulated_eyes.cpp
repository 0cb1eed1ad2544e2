#include "host/eyes/simulated_eyes.hpp"

#include <string>
#include <utility>

#include "host/eyes/photograph_look.hpp"
#include "host/eyes/sign_look.hpp"

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
  LookingChild* child;
};

base::Task<std::optional<robot::Look>> look_for_tags(Camera camera) {
  if (!camera.child->may_be_asked()) co_return std::nullopt;
  auto shot = camera.in->shoot(camera.robot, camera.settings);
  if (!shot) co_return std::nullopt;
  auto asking = camera.child->ask([shot = *std::move(shot)] { return sign_request(developed(shot)); });
  auto const answer = co_await std::move(asking);
  auto seen = answer ? signs_in(*answer) : base::fail(base::ErrorKind::lost, "");
  if (!seen) co_return std::nullopt;
  robot::Look look{.found = {}, .is_sharp = seen->is_sharp};
  for (auto& [sign, crop] : seen->signs) look.found.push_back({.what = std::move(sign), .crop = std::move(crop)});
  co_return look;
}

base::Task<base::Result<robot::Photograph>> take_photograph(Camera camera) {
  auto shot = camera.in->shoot(camera.robot, camera.settings);
  if (!shot) co_return base::fail(base::ErrorKind::lost, "the camera gives no picture");
  auto asking = camera.child->ask([shot = *std::move(shot)] { return photograph_request(developed(shot)); });
  auto const answer = co_await std::move(asking);
  if (!answer) co_return std::unexpected(answer.error());
  auto picture = photograph_in(*answer);
  if (!picture) co_return std::unexpected(picture.error());
  co_return robot::Photograph{.jpeg = std::move(picture->jpeg),
                              .thumbnail = std::move(picture->thumbnail),
                              .width_px = picture->width,
                              .height_px = picture->height};
}

}  // namespace

robot::Eyes simulated_eyes(building::Building& in, std::size_t robot, LookingChild& child) {
  robot::Eyes eyes;
  auto const& settings = in.robot(robot).settings();
  for (auto const& side : settings.side_cameras) {
    Camera const camera{.in = &in, .robot = robot, .settings = side, .child = &child};
    eyes.for_tags.push_back({.mount = mount_of(side), .look = [camera] { return look_for_tags(camera); }});
  }
  Camera const ahead{.in = &in, .robot = robot, .settings = settings.camera, .child = &child};
  eyes.photographer = {.mount = mount_of(settings.camera), .take = [ahead] { return take_photograph(ahead); }};
  return eyes;
}

}  // namespace lapwing::host
