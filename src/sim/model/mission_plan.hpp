#pragma once

#include <string_view>
#include <vector>

#include "mavlink/codec/messages.hpp"
#include "sim/model/kind.hpp"
#include "sim/model/site.hpp"
#include "vehicle/family.hpp"

namespace lapwing::sim {

/// What the vehicle holds to fly, in the form in which it stores it (`normalised`). Item 0 is home, the first real item
/// is 1, also where the wire begins with the first real item (PX4): `wire_seq`.
using MissionPlan = std::vector<mavlink::MissionItem>;

/// All that a vehicle holds; outlives a reboot.
struct Plans {
  MissionPlan mission;
  MissionPlan fence;
  MissionPlan rally;
};

/// Navigation commands follow each other; everything else ("do" commands) runs on the way between two of them.
[[nodiscard]] bool is_navigation(mavlink::MavCmd command);
/// Whether that family's autopilot can fly the navigation command; what it cannot is stored but skipped
/// (`plan::handling`, less what is not simulated).
[[nodiscard]] bool can_fly(vehicle::Family family, mavlink::MavCmd command);
/// ArduPilot's short name in status texts: "WP", "Takeoff".
[[nodiscard]] std::string_view short_name(mavlink::MavCmd command);

/// Where the item is in the site's frame. Latitude and longitude 0 mean "here", as in ArduPilot.
[[nodiscard]] geo::Ned point_of(mavlink::MissionItem const& item, Site const& site, geo::Ned home, geo::Ned here);

/// The same, in what is stored: used to notice an upload that changes the command being flown.
[[nodiscard]] bool same_item(mavlink::MissionItem const& a, mavlink::MissionItem const& b);

/// The item as it reads back from ArduPilot: frames folded, altitude cut to centimetres, parameters that it has no room
/// for dropped.
[[nodiscard]] mavlink::MissionItem normalised(mavlink::MissionItem item);

/// The number under which a vehicle speaks of the item `index` of its mission, and back.
[[nodiscard]] std::uint16_t wire_seq(Kind const& kind, int index);
[[nodiscard]] int plan_index(Kind const& kind, int seq);

/// Why the vehicle would not store the item in a mission of `total` items, as numbered on the wire; `accepted` when it
/// would.
[[nodiscard]] mavlink::MavMissionResult refusal(mavlink::MissionItem const& item, Kind const& kind, int total);

}  // namespace lapwing::sim
