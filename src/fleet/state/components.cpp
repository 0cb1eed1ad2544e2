#include "fleet/state/components.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace lapwing::fleet {

namespace {

constexpr std::size_t components_kept = 32;

struct Range {
  std::uint8_t first;
  std::uint8_t last;
  std::string_view kind;
};
/// MAV_COMPONENT, for components that do not say their type.
constexpr Range numbers[] = {
    {100, 105, "camera"},
    {140, 153, "servo"},
    {154, 154, "gimbal"},
    {156, 156, "ADS-B receiver"},
    {161, 161, "parachute"},
    {169, 169, "winch"},
    {171, 175, "gimbal"},
    {180, 181, "battery"},
    {191, 194, "companion computer"},
    {220, 221, "GPS"},
    {236, 238, "remote ID"},
};

std::string_view kind_by_type(mavlink::MavType type) {
  switch (std::to_underlying(type)) {  // MAV_TYPE, beyond what vehicles need
    case 18: return "companion computer";
    case 26: return "gimbal";
    case 27: return "ADS-B receiver";
    case 30: return "camera";
    case 32: return "FLARM";
    case 33: return "servo";
    case 34: return "remote ID";
    case 36: return "battery";
    case 37: return "parachute";
    case 41: return "GPS";
    case 42: return "winch";
    default: return "";
  }
}

std::string_view kind_by_number(std::uint8_t component) {
  for (auto const& range : numbers)
    if (component >= range.first && component <= range.last) return range.kind;
  return "component";
}

}  // namespace

std::string_view component_kind(mavlink::Address source, mavlink::Heartbeat const& heartbeat) {
  if (source.component == mavlink::autopilot_component || source.component == 0) return "";
  if (heartbeat.type == mavlink::MavType::gcs) return "";
  auto const by_type = kind_by_type(heartbeat.type);
  return by_type.empty() ? kind_by_number(source.component) : by_type;
}

vehicle::Component* component_of(std::vector<vehicle::Component>& all, int id, std::string_view kind) {
  auto const key = [](vehicle::Component const& component) { return std::tuple(component.id, component.kind); };
  auto const place = std::ranges::lower_bound(all, std::tuple(id, kind), {}, key);
  if (place != all.end() && key(*place) == std::tuple(id, kind)) return &*place;
  if (all.size() >= components_kept) return nullptr;
  return &*all.insert(place, {.id = id, .kind = kind});
}

std::string_view state_word(mavlink::MavState state) {
  using enum mavlink::MavState;
  switch (state) {
    case boot: return "starting";
    case calibrating: return "calibrating";
    case standby: return "standby";
    case active: return "active";
    case critical: return "critical";
    case emergency: return "emergency";
    case poweroff: return "off";
    case flight_termination: return "terminating flight";
    case uninit: break;
  }
  return "";
}

}  // namespace lapwing::fleet
