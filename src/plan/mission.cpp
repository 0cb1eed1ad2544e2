#include "plan/mission.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::plan {

using mavlink::MavCmd;
using mavlink::MissionItem;

bool has_position(MissionItem const& item) {
  switch (item.command) {
    case MavCmd::nav_waypoint:
    case MavCmd::nav_loiter_unlim:
    case MavCmd::nav_loiter_turns:
    case MavCmd::nav_loiter_time:
    case MavCmd::nav_land:
    case MavCmd::nav_takeoff:
    case MavCmd::do_set_home: return true;
    default: return false;
  }
}

geo::Wgs84 position_of(MissionItem const& item) {
  return {item.place.lat_rad, item.place.lon_rad, item.place.z_m};
}

bool takes_photos(Mission const& mission) {
  return std::ranges::any_of(mission.items,
                             [](auto const& item) { return item.command == MavCmd::image_start_capture; });
}

namespace {

MissionItem home_item(geo::Wgs84 home) {
  MissionItem item;
  item.command = MavCmd::nav_waypoint;
  item.place = {.lat_rad = home.lat_rad, .lon_rad = home.lon_rad, .z_m = home.alt_m};
  return item;
}

/// DO_CHANGE_ALTITUDE as an item that ArduPilot accepts; `before_m` is the altitude that it starts from.
MissionItem as_nav_change_alt(MissionItem const& change, std::optional<double> before_m) {
  float constexpr neutral = 0.0F;
  float constexpr climb = 1.0F;
  float constexpr descend = 2.0F;
  MissionItem item;
  item.command = MavCmd::nav_continue_and_change_alt;
  item.place.z_m = change.params[0];
  if (!before_m || *before_m == item.place.z_m) {
    item.params[0] = neutral;
  } else {
    item.params[0] = *before_m < item.place.z_m ? climb : descend;
  }
  return item;
}

std::vector<MissionItem> for_ardupilot(Mission const& mission, std::optional<geo::Wgs84> vehicle_home) {
  auto const home = mission.home ? mission.home : vehicle_home;
  std::vector<MissionItem> items{home_item(home.value_or(geo::Wgs84{}))};
  std::optional<double> altitude_m;
  if (home) altitude_m = home->alt_m;
  for (auto const& item : mission.items) {
    bool const is_change = item.command == MavCmd::do_change_altitude;
    items.push_back(is_change ? as_nav_change_alt(item, altitude_m) : item);
    if (is_change || (has_position(item) && item.command != MavCmd::do_set_home)) altitude_m = items.back().place.z_m;
  }
  return items;
}

std::vector<MissionItem> without_home_item(Mission const& mission) {
  auto items = mission.items;
  for (auto& item : items) {
    if (item.command == MavCmd::do_jump) item.params[0] -= 1.0F;
  }
  return items;
}

}  // namespace

std::vector<MissionItem> for_autopilot(Mission const& mission, vehicle::Autopilot autopilot,
                                       std::optional<geo::Wgs84> vehicle_home) {
  auto items =
      autopilot == vehicle::Autopilot::ardupilot ? for_ardupilot(mission, vehicle_home) : without_home_item(mission);
  for (std::size_t i = 0; i < items.size(); ++i) items[i].seq = static_cast<std::uint16_t>(i);
  return items;
}

}  // namespace lapwing::plan
