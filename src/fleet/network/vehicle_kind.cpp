#include "fleet/network/vehicle_kind.hpp"

#include "mavlink/wire/modes.hpp"

namespace lapwing::fleet {

using mavlink::MavType;
using vehicle::Family;

namespace {

constexpr std::uint8_t first_camera = 100;  // MAV_COMP_ID_CAMERA .. MAV_COMP_ID_CAMERA6
constexpr std::uint8_t last_camera = 105;

/// The language's vehicle types (specification, REC-44); nothing for what is no vehicle.
std::optional<std::string_view> type_of(MavType type) {
  switch (mavlink::family_of(type)) {
    case Family::copter:
    case Family::plane:
    case Family::vtol: return "UAV";
    case Family::rover: return "UGV";
    case Family::boat: return "USV";
    case Family::sub: return "UUV";
    case Family::robot:  // none that speaks MAVLink
    case Family::unknown: break;
  }
  switch (type) {
    case MavType::airship:
    case MavType::flapping_wing:
    case MavType::kite:
    case MavType::parafoil: return "UAV";
    case MavType::generic: return "";
    default: return std::nullopt;
  }
}

}  // namespace

std::optional<VehicleKind> kind_of(mavlink::Address source, mavlink::Heartbeat const& heartbeat) {
  if (source.component != mavlink::autopilot_component || source.system == 0) return std::nullopt;
  if (heartbeat.autopilot == mavlink::MavAutopilot::invalid) return std::nullopt;
  auto const type = type_of(heartbeat.type);
  if (!type) return std::nullopt;
  return VehicleKind{mavlink::family_of(heartbeat.type), mavlink::autopilot_of(heartbeat.autopilot), *type};
}

bool is_camera(mavlink::Address source, mavlink::Heartbeat const& heartbeat) {
  return heartbeat.type == MavType::camera || (source.component >= first_camera && source.component <= last_camera);
}

}  // namespace lapwing::fleet
