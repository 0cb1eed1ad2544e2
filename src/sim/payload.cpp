// The flight controller's side of cameras and gimbals.
#include <cmath>

#include "sim/flight_controller.hpp"

namespace lapwing::sim {

using namespace mavlink;

namespace {

/// CAM1_TYPE: 0 no camera; 6 one that tells of each picture by CAMERA_IMAGE_CAPTURED and repeats it when asked (here
/// the autopilot speaks for it); any other number one that is only triggered, with CAMERA_FEEDBACK.
constexpr int no_camera = 0;
constexpr int camera_that_answers = 6;

geo::Wgs84 place_of(Camera::Shot const& shot, Site const& site) {
  return site.place_at(shot.position_m);
}

}  // namespace

int FlightController::camera_type() const {
  return static_cast<int>(memory_.parameters.value("CAM1_TYPE"));
}

std::optional<MavResult> FlightController::perform_payload(CommandInt const& command) {
  auto const home = autopilot_.home();
  std::optional<geo::Ned> target;
  bool const has_target = command.place.lat_rad != 0.0 || command.place.lon_rad != 0.0;
  if (home && has_place(command.command) && has_target) {
    MissionItem item{.frame = command.frame, .command = command.command, .place = command.place};
    target = point_of(item, site_, *home, autopilot_.body().position_m);
  }
  if (camera_type() != no_camera && camera_.perform(command.command, command.params, command.place, since_power_on()))
    return MavResult::accepted;
  if (!has_gimbal()) return std::nullopt;
  return gimbal_.perform(command.command, command.params, command.place, target);
}

void FlightController::perform_payload(MissionItem const& item) {
  (void)perform_payload(CommandInt{
      .target = {}, .frame = item.frame, .command = item.command, .params = item.params, .place = item.place});
}

CameraImageCaptured FlightController::captured(Camera::Shot const& shot) const {
  CameraImageCaptured message;
  message.since_boot = shot.at;
  message.camera = 1;
  message.position = place_of(shot, site_);
  message.relative_alt_m = autopilot_.home().value_or(geo::Ned{}).down - shot.position_m.down;
  message.orientation = {1.0F, 0.0F, 0.0F, 0.0F};
  message.image = shot.index;
  message.captured = true;
  return message;
}

CameraFeedback FlightController::feedback(Camera::Shot const& shot) const {
  CameraFeedback message;
  message.time = std::chrono::duration_cast<std::chrono::microseconds>(loop_.utc_now().time_since_epoch());
  message.image = static_cast<std::uint16_t>(shot.index + 1);  // ArduPilot counts from 1
  message.position = place_of(shot, site_);
  message.relative_alt_m = autopilot_.home().value_or(geo::Ned{}).down - shot.position_m.down;
  message.roll_rad = shot.attitude.roll_rad;
  message.pitch_rad = shot.attitude.pitch_rad;
  message.yaw_rad = shot.attitude.yaw_rad;
  message.completed_captures = message.image;
  return message;
}

void FlightController::step_payload(base::Duration dt) {
  gimbal_.step(autopilot_.body(), base::to_seconds(dt));
  for (auto const& shot : camera_.step(autopilot_.body(), since_power_on())) {
    if (camera_type() == camera_that_answers) {
      broadcast(captured(shot));
    } else {
      broadcast(feedback(shot));
    }
  }
}

/// What is asked for by REQUEST_MESSAGE about payload; nothing for other messages.
std::optional<Message> FlightController::payload_report(MessageId id, float argument) const {
  switch (id) {
    case MessageId::gimbal_device_attitude_status:
      return has_gimbal() ? std::optional<Message>(gimbal_.status(since_power_on())) : std::nullopt;
    case MessageId::gimbal_manager_information:
      return has_gimbal() ? std::optional<Message>(Gimbal::information(since_power_on())) : std::nullopt;
    case MessageId::camera_information:
      if (camera_type() == no_camera) return std::nullopt;
      // ArduPilot does not know what is wired to its servo or relay.
      if (camera_type() != camera_that_answers) return CameraInformation{.since_boot = since_power_on(), .flags = 2};
      return CameraInformation{.since_boot = since_power_on(),
                               .vendor = "Lapwing",
                               .model = "simulated camera",
                               .width_px = 4000,
                               .height_px = 3000,
                               .flags = 2,  // CAMERA_CAP_FLAGS_CAPTURE_IMAGE
                               .camera = 1};
    case MessageId::camera_image_captured: {
      auto const& shots = camera_.shots();
      bool const has_it = argument >= 0.0F && static_cast<std::size_t>(argument) < shots.size();
      if (camera_type() != camera_that_answers || !has_it) return std::nullopt;
      return captured(shots[static_cast<std::size_t>(argument)]);
    }
    default: return std::nullopt;
  }
}

bool FlightController::has_gimbal() const {
  return memory_.parameters.value("MNT1_TYPE") != 0.0;
}

}  // namespace lapwing::sim
