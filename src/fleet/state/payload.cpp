#include "fleet/state/payload.hpp"

#include <cmath>

#include "fleet/state/components.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::TimePoint;
using mavlink::MessageId;

namespace {

constexpr base::Duration gimbal_status_prevails = 5s;  // over MOUNT_STATUS
constexpr std::uint8_t first_real_component = 7;       // below it a gimbal device is one of the autopilot's own

/// Roll, pitch, yaw in that order about the axes that the turns before left (Z-Y-X). Straight up or down roll and yaw
/// are one turn, which is then called yaw.
vehicle::Gimbal pointing(std::array<float, 4> const& q) {
  double const w = q[0], x = q[1], y = q[2], z = q[3];
  double const sine = std::clamp(2.0 * (w * y - z * x), -1.0, 1.0);
  vehicle::Gimbal gimbal;
  gimbal.pitch_rad = std::asin(sine);
  constexpr double nearly_vertical = 0.9999;
  if (std::abs(sine) > nearly_vertical) {
    gimbal.yaw_rad = std::atan2(2.0 * (w * z - x * y), 1.0 - 2.0 * (x * x + z * z));
    return gimbal;
  }
  gimbal.roll_rad = std::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y));
  gimbal.yaw_rad = std::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
  return gimbal;
}

bool yaw_is_from_north(std::uint16_t flags) {
  using namespace mavlink::gimbal_flag;
  if ((flags & yaw_in_earth_frame) != 0) return true;
  return (flags & yaw_lock) != 0 && (flags & yaw_in_vehicle_frame) == 0;
}

void name_component(MavlinkVehicle& craft, int id, std::string_view kind, std::string model, TimePoint now) {
  auto* const known = component_of(craft.state.payload.components, id, kind);
  if (!known) return;
  if (!model.empty()) known->model = std::move(model);
  known->heard = now;
}

void ask_about_missing_pictures(MavlinkVehicle& craft, PictureTrace& pictures) {
  for (auto const& missing : pictures.take_missing())
    ask(craft, {MessageId::camera_image_captured, missing.component, static_cast<float>(missing.image)});
}

}  // namespace

/// One overload for each message that tells of payload; everything else falls through to the template.
struct PayloadTaking {
  static Heard& kept_of(MavlinkVehicle& vehicle) { return vehicle.heard.write(As<PayloadTaking>()); }
  static Asked& asked_of(MavlinkVehicle& vehicle) { return vehicle.asked.write(As<PayloadTaking>()); }

  MavlinkVehicle& craft;
  std::uint8_t component;
  TimePoint now;
  Heard& kept = kept_of(craft);
  Asked& asked = asked_of(craft);

  template <class Other>
  bool operator()(Other const&) const {
    return false;
  }

  bool operator()(mavlink::CameraImageCaptured const& heard) const {
    bool const shows = kept.pictures.take(heard, component, craft.state.payload.pictures, now);
    ask_about_missing_pictures(craft, kept.pictures);
    return shows;
  }
  bool operator()(mavlink::CameraFeedback const& heard) const {
    return kept.pictures.take(heard, craft.state.payload.pictures, now);
  }
  bool operator()(mavlink::CameraTrigger const& heard) const {
    return kept.pictures.take(heard, craft.state.motion.position.value, craft.state.payload.pictures, now);
  }

  bool operator()(mavlink::CameraInformation const& heard) const {
    auto model = heard.vendor.empty() ? heard.model : heard.vendor + " " + heard.model;
    name_component(craft, component, "camera", std::move(model), now);
    return true;
  }
  bool operator()(mavlink::GimbalManagerInformation const& heard) const {
    bool const speaks_for_itself = heard.gimbal_device >= first_real_component;
    name_component(craft, speaks_for_itself ? heard.gimbal_device : component, "gimbal", {}, now);
    if (asked.rates) asked.rates->want({MessageId::gimbal_device_attitude_status, 1s, true}, now);
    return true;
  }

  bool operator()(mavlink::GimbalDeviceAttitudeStatus const& heard) const {
    if (!heard.orientation) return false;
    auto gimbal = pointing(*heard.orientation);
    gimbal.yaw_is_from_north = yaw_is_from_north(heard.flags);
    craft.state.payload.gimbal.set(gimbal, now);
    kept.gimbal_status_heard = now;
    return true;
  }
  bool operator()(mavlink::MountStatus const& heard) const {
    if (craft.heard->gimbal_status_heard && now - *craft.heard->gimbal_status_heard < gimbal_status_prevails)
      return false;
    if (!heard.roll_rad || !heard.pitch_rad || !heard.yaw_rad) return false;
    craft.state.payload.gimbal.set({*heard.roll_rad, *heard.pitch_rad, *heard.yaw_rad, false}, now);
    return true;
  }

  bool operator()(mavlink::AvailableModes const& heard) const {
    if (component != mavlink::autopilot_component) return false;
    kept.modes.take(heard);
    if (heard.custom_mode == craft.heard->custom_mode && craft.heard->mode_is_unnamed)
      craft.state.mode.value = heard.name;
    return true;
  }
  bool operator()(mavlink::AvailableModesMonitor const& heard) const {
    if (component == mavlink::autopilot_component && kept.modes.take(heard)) asked.has_asked_for_modes = false;
    return false;
  }
};

bool take_payload(MavlinkVehicle& craft, std::uint8_t component, mavlink::Message const& message, TimePoint now) {
  return std::visit(PayloadTaking{craft, component, now}, message);
}

void take_component_heartbeat(MavlinkVehicle& craft, mavlink::Address source, mavlink::Heartbeat const& heartbeat,
                              TimePoint now) {
  auto const kind = component_kind(source, heartbeat);
  if (kind.empty()) return;
  auto const known = craft.state.payload.components.size();
  auto* const component = component_of(craft.state.payload.components, source.component, kind);
  if (!component) return;
  component->state = state_word(heartbeat.system_status);
  component->heard = now;
  bool const is_new = craft.state.payload.components.size() > known;
  if (!is_new) return;
  if (kind == "camera") ask(craft, {MessageId::camera_information, source.component});
  if (kind == "gimbal") ask(craft, {MessageId::gimbal_manager_information, source.component});
}

void ask_for_payload(MavlinkVehicle& craft) {
  ask(craft, {MessageId::gimbal_manager_information, craft.address.component});
  ask(craft, {MessageId::camera_information, craft.address.component});
}

std::string name_of_mode(MavlinkVehicle& craft, mavlink::MavType type, std::uint32_t custom_mode) {
  auto const& state = craft.state;
  auto const known = mavlink::known_mode_name(state.autopilot, state.family, type, custom_mode);
  PayloadTaking::kept_of(craft).mode_is_unnamed = known.empty();
  if (!known.empty()) return std::string(known);
  if (auto name = craft.heard->modes.name(custom_mode)) return *std::move(name);
  if (!craft.asked->has_asked_for_modes) ask(craft, {MessageId::available_modes, craft.address.component});
  PayloadTaking::asked_of(craft).has_asked_for_modes = true;
  return mavlink::mode_name(state.autopilot, state.family, custom_mode);
}

}  // namespace lapwing::fleet
