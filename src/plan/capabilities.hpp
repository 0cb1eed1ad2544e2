#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "mavlink/codec/messages.hpp"
#include "vehicle/family.hpp"

/// What each autopilot makes of a mission item: the one place where that is known.
///
/// Sources: ArduPilot 4.7, stored: `AP_Mission::mavlink_int_to_mission_cmd`, and every command was offered to its
/// copter, rover and plane simulators in a mission of one item; carried out: `AP_Mission::start_command`, then
/// `ModeAuto::start_command` of copter and rover, `Plane::start_command`, `Sub::start_command`. PX4:
/// `MavlinkMissionManager::parse_mavlink_mission_item`.
namespace lapwing::plan {

enum class Handling {
  carried_out,
  skipped,  ///< taken on upload, but the vehicle goes on to the next item when its turn comes
  refused,  ///< answered with a MISSION_ACK that is not ACCEPTED
  unknown,  ///< not known here: the upload will tell
};

[[nodiscard]] Handling handling(vehicle::Autopilot autopilot, vehicle::Family family, mavlink::MavCmd command);

/// The families behind the name by which scripts ask for vehicles ("UAV"); nothing for other names.
[[nodiscard]] std::vector<vehicle::Family> families_of(std::string_view vehicle_type);

/// Why the vehicle would not carry out the items as they are, `for_autopilot` having made them its own: names the first
/// such item, its command and the vehicle ("item 2, NAV_TAKEOFF: ..."). Nothing when it would, or when nothing is known
/// of such vehicles.
[[nodiscard]] std::optional<base::Error> objection(std::span<mavlink::MissionItem const> items,
                                                   vehicle::Autopilot autopilot, vehicle::Family family);

}  // namespace lapwing::plan
