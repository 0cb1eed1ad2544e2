#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/position.hpp"
#include "mavlink/codec/messages.hpp"
#include "vehicle/family.hpp"

namespace lapwing::plan {

/// MISSION_COUNT is 16 bits wide; vehicles hold far fewer, and say so.
inline constexpr std::size_t max_mission_items = 65535;

/// What one vehicle is to do, as mission items that no autopilot's habits have touched yet (`for_autopilot` does that).
/// Places are in global frames: altitudes above mean sea level, but missions from files may hold them above home or
/// terrain too (`place_of`). Numbers in `do_jump` count from 1, the first of `items`.
struct Mission {
  std::string name;
  /// From a `home` that stands before every other command: becomes the vehicle's home when the mission starts.
  std::optional<geo::Wgs84> home;
  /// Where the vehicle was thought to start when the mission was drawn. For estimates; no vehicle's home is moved
  /// there.
  std::optional<geo::Wgs84> planned_home = std::nullopt;
  std::vector<mavlink::MissionItem> items;
};

/// True for commands whose place is a point to go to or to act at.
[[nodiscard]] bool has_position(mavlink::MissionItem const& item);
/// As it stands in the item, whatever its frame.
[[nodiscard]] geo::Wgs84 position_of(mavlink::MissionItem const& item);
/// Where the item takes a vehicle that is at `here` and whose home lies `home_alt_m` above mean sea level: altitudes
/// above home, or above a terrain that is taken to be as high as home, become such above mean sea level; latitude and
/// longitude 0 mean "here".
[[nodiscard]] geo::Wgs84 place_of(mavlink::MissionItem const& item, std::optional<geo::Wgs84> here, double home_alt_m);
/// What the altitude of a DO_CHANGE_ALTITUDE counts from: its second parameter, not the frame of the item. Nothing when
/// it tells no altitude on Earth: then nobody knows what is meant.
[[nodiscard]] std::optional<mavlink::MavFrame> frame_of_change(mavlink::MissionItem const& change);
/// It takes pictures, so the vehicle needs a camera.
[[nodiscard]] bool takes_photos(Mission const& mission);

/// The items as the autopilot wants them, numbered from 0.
///
/// ArduPilot reads item 0 as home and never flies it: it gets the mission's home, else `vehicle_home`, else zeros,
/// which it replaces (REC-33). Other autopilots get no extra item, so the targets of jumps are one lower; PX4 wants
/// items without a place in the frame `mission`.
///
/// A change of altitude becomes what the vehicle flies: a waypoint at that altitude above the last place for
/// ArduPilot's copters and underwater vehicles (without an earlier place: above where they are) and for PX4, else
/// NAV_CONTINUE_AND_CHANGE_ALT on ArduPilot. PX4 without an earlier place keeps the command, and refuses it. So does
/// every vehicle with one that says no altitude on Earth.
[[nodiscard]] std::vector<mavlink::MissionItem> for_autopilot(Mission const& mission, vehicle::Autopilot autopilot,
                                                              std::optional<geo::Wgs84> vehicle_home,
                                                              vehicle::Family family = vehicle::Family::unknown);

}  // namespace lapwing::plan
