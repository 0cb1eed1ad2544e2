#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/position.hpp"
#include "mavlink/messages.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::plan {

/// MISSION_COUNT is 16 bits wide; vehicles hold far fewer, and say so.
inline constexpr std::size_t max_mission_items = 65535;

/// What one vehicle is to do, as mission items that no autopilot's habits have touched yet (`for_autopilot` does that).
/// Places are in the global frame, altitudes above mean sea level. Numbers in `do_jump` count from 1, the first of
/// `items`.
struct Mission {
  std::string name;
  /// From a `home` that stands before every other command: becomes the vehicle's home when the mission starts.
  std::optional<geo::Wgs84> home;
  std::vector<mavlink::MissionItem> items;
};

/// True for commands whose place is a point to go to or to act at.
[[nodiscard]] bool has_position(mavlink::MissionItem const& item);
[[nodiscard]] geo::Wgs84 position_of(mavlink::MissionItem const& item);
/// It takes pictures, so the vehicle needs a camera.
[[nodiscard]] bool takes_photos(Mission const& mission);

/// The items as the autopilot wants them, numbered from 0.
///
/// ArduPilot reads item 0 as home and never flies it: it gets the mission's home, else `vehicle_home`, else zeros,
/// which it replaces (REC-33). It has no DO_CHANGE_ALTITUDE in missions: NAV_CONTINUE_AND_CHANGE_ALT stands in. Other
/// autopilots get no extra item, so the targets of jumps are one lower.
[[nodiscard]] std::vector<mavlink::MissionItem> for_autopilot(Mission const& mission, vehicle::Autopilot autopilot,
                                                              std::optional<geo::Wgs84> vehicle_home);

}  // namespace lapwing::plan
