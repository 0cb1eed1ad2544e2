#pragma once

#include <optional>
#include <string_view>

#include "mavlink/codec/messages.hpp"
#include "vehicle/family.hpp"

namespace lapwing::fleet {

/// What a heartbeat says about the vehicle that sends it.
struct VehicleKind {
  vehicle::Family family = vehicle::Family::unknown;
  vehicle::Autopilot autopilot = vehicle::Autopilot::other;
  std::string_view type;  ///< as scripts ask for it: "UAV", "UGV", "USV", "UUV"; empty when MAV_TYPE does not tell
};

/// The vehicle behind a heartbeat, or nothing when no autopilot of a vehicle sent it: ground stations (also when a
/// vehicle forwards their heartbeats), cameras, gimbals, ADS-B receivers, antenna trackers and onboard computers.
[[nodiscard]] std::optional<VehicleKind> kind_of(mavlink::Address source, mavlink::Heartbeat const& heartbeat);

/// Whether the heartbeat comes from a camera aboard its system (MAV_TYPE_CAMERA, or one of the camera components 100 to
/// 105).
[[nodiscard]] bool is_camera(mavlink::Address source, mavlink::Heartbeat const& heartbeat);

}  // namespace lapwing::fleet
