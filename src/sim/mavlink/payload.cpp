// The flight controller's side of cameras and gimbals.
#include <cmath>

#include "sim/mavlink/flight_controller.hpp"

namespace lapwing::sim {

using namespace mavlink;

namespace {

constexpr std::uint8_t camera_component = 100;
constexpr std::uint8_t gimbal_component = 154;
constexpr base::Duration gimbal_status_period = std::chrono::milliseconds(500);

/// CAM1_TYPE: 0 no camera; 6 one that tells of each picture by CAMERA_IMAGE_CAPTURED and repeats it when asked (here
/// the autopilot speaks for it); any other number one that is only triggered, with CAMERA_FEEDBACK.
constexpr int no_camera = 0;
constexpr int camera_that_answers = 6;

geo::Wgs84 place_of(Camera::Shot const& shot, Site const& site) {
  return site.place_at(shot.position_m);
}

}  // namespace

int FlightController::camera_type() const {
  if (is_px4()) return has_camera_node() ? camera_that_answers : no_camera;
  return static_cast<int>(memory_.parameters.value("CAM1_TYPE"));
}

bool FlightController::has_camera_node() const {
  constexpr double mavlink_camera = 3.0;
  return is_px4() && memory_.parameters.value("TRIG_INTERFACE") == mavlink_camera;
}

bool FlightController::has_gimbal_node() const {
  constexpr double mavlink_gimbal = 2.0;
  return is_px4() && memory_.parameters.value("MNT_MODE_OUT") == mavlink_gimbal;
}

std::unique_ptr<PayloadNode> FlightController::make_node(std::uint8_t component, MavType type, PayloadNode::Ports ports,
                                                         std::unique_ptr<link::ByteLink> link) {
  ports.silent = [this] { return silent() || since_power_on() < autopilot_.boot().first_heartbeat; };
  PayloadNode::Setup const setup{
      .self = {connection_.self().system, component}, .type = type, .signing_key = memory_.signing_key};
  return std::make_unique<PayloadNode>(loop_, setup, std::move(ports), std::move(link), log_);
}

void FlightController::connect_camera(std::unique_ptr<link::ByteLink> link) {
  PayloadNode::Ports ports;
  ports.perform = [this](CommandInt const& command) -> std::optional<MavResult> {
    bool const done = camera_.perform(command.command, command.params, command.place, since_power_on());
    return done ? std::optional(MavResult::accepted) : std::nullopt;
  };
  ports.report = [this](MessageId id, float argument) { return camera_report(id, argument); };
  camera_node_ = make_node(camera_component, MavType::camera, std::move(ports), std::move(link));
}

/// It takes its angles from its manager, which is the autopilot.
void FlightController::connect_gimbal(std::unique_ptr<link::ByteLink> link) {
  PayloadNode::Ports ports;
  ports.perform = [](CommandInt const&) { return std::optional<MavResult>(); };
  ports.report = [this](MessageId id, float) -> std::optional<Message> {
    return id == MessageId::gimbal_device_attitude_status ? gimbal_report(id) : std::nullopt;
  };
  gimbal_node_ = make_node(gimbal_component, MavType::gimbal, std::move(ports), std::move(link));
}

bool FlightController::is_for_a_node(Address target) const {
  return (camera_node_ && target.component == camera_component) ||
         (gimbal_node_ && target.component == gimbal_component);
}

std::optional<MavResult> FlightController::perform_payload(CommandInt const& command) {
  if (!is_px4())
    if (auto const result = outputs_.perform(command.command, command.params)) return result;
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
  message.camera = camera_node_ ? 0 : 1;
  message.position = place_of(shot, site_);
  message.relative_alt_m = autopilot_.home().value_or(geo::Ned{}).down - shot.position_m.down;
  message.orientation = std::array{1.0F, 0.0F, 0.0F, 0.0F};
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
  auto const now = since_power_on();
  gimbal_.step(autopilot_.body(), base::to_seconds(dt));
  for (auto const& shot : camera_.step(autopilot_.body(), now)) {
    if (camera_node_) {
      camera_node_->tell(captured(shot));
    } else if (camera_type() == camera_that_answers) {
      broadcast(captured(shot));
    } else {
      broadcast(feedback(shot));
    }
  }
  if (camera_node_) camera_node_->step(now);
  if (!gimbal_node_) return;
  gimbal_node_->step(now);
  if (now < next_gimbal_status_) return;
  next_gimbal_status_ = now + gimbal_status_period;
  gimbal_node_->tell(*gimbal_report(MessageId::gimbal_device_attitude_status));
}

/// What the autopilot is asked for by REQUEST_MESSAGE about payload; nothing for other messages.
std::optional<Message> FlightController::payload_report(MessageId id, float argument) const {
  if (auto const message = gimbal_report(id)) return message;
  return camera_node_ ? std::nullopt : camera_report(id, argument);
}

std::optional<Message> FlightController::gimbal_report(MessageId id) const {
  if (!has_gimbal()) return std::nullopt;
  if (id == MessageId::gimbal_device_attitude_status) {
    auto status = gimbal_.status(since_power_on());
    if (gimbal_node_) status.gimbal_device = 0;  // the sender is the device
    return status;
  }
  if (id != MessageId::gimbal_manager_information) return std::nullopt;
  auto information = Gimbal::information(since_power_on());
  if (gimbal_node_) information.gimbal_device = gimbal_component;
  return information;
}

std::optional<Message> FlightController::camera_report(MessageId id, float argument) const {
  if (id == MessageId::camera_information) {
    if (camera_type() == no_camera) return std::nullopt;
    // ArduPilot does not know what is wired to its servo or relay.
    constexpr std::uint32_t takes_pictures = 2;  // CAMERA_CAP_FLAGS_CAPTURE_IMAGE
    CameraInformation information{.since_boot = since_power_on(), .flags = takes_pictures};
    if (camera_type() != camera_that_answers) return information;
    information.vendor = "Lapwing";
    information.model = "simulated camera";
    information.width_px = 4000;
    information.height_px = 3000;
    information.camera = camera_node_ ? 0 : 1;
    return information;
  }
  if (id != MessageId::camera_image_captured || camera_type() != camera_that_answers) return std::nullopt;
  auto const& shots = camera_.shots();
  bool const has_it = argument >= 0.0F && static_cast<std::size_t>(argument) < shots.size();
  return has_it ? std::optional<Message>(captured(shots[static_cast<std::size_t>(argument)])) : std::nullopt;
}

bool FlightController::has_gimbal() const {
  return has_gimbal_node() || memory_.parameters.value("MNT1_TYPE") != 0.0;
}

}  // namespace lapwing::sim
