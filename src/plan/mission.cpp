#include "plan/mission.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lapwing::plan {

using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MissionItem;

bool has_position(MissionItem const& item) {
  switch (item.command) {
    case MavCmd::nav_waypoint:
    case MavCmd::nav_loiter_unlim:
    case MavCmd::nav_loiter_turns:
    case MavCmd::nav_loiter_time:
    case MavCmd::nav_land:
    case MavCmd::nav_takeoff:
    case MavCmd::nav_loiter_to_alt:
    case MavCmd::nav_spline_waypoint:
    case MavCmd::nav_vtol_takeoff:
    case MavCmd::nav_vtol_land:
    case MavCmd::nav_payload_place:
    case MavCmd::do_set_home: return true;
    default: return false;
  }
}

geo::Wgs84 position_of(MissionItem const& item) {
  return {item.place.lat_rad, item.place.lon_rad, item.place.z_m};
}

geo::Wgs84 place_of(MissionItem const& item, std::optional<geo::Wgs84> here, double home_alt_m) {
  using enum mavlink::MavFrame;
  auto place = position_of(item);
  if (item.frame != global && item.frame != global_int && item.frame != mission) place.alt_m += home_alt_m;
  bool const is_here = place.lat_rad == 0.0 && place.lon_rad == 0.0;
  return is_here && here ? geo::Wgs84{here->lat_rad, here->lon_rad, place.alt_m} : place;
}

std::optional<MavFrame> frame_of_change(MissionItem const& change) {
  float const number = change.params[1];
  if (!std::isfinite(change.params[0]) || !(number >= 0.0F && number <= 255.0F)) return std::nullopt;
  auto const frame = static_cast<MavFrame>(static_cast<int>(number));
  return mavlink::is_global(frame) ? std::optional(frame) : std::nullopt;
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

/// An altitude and what it counts from.
struct Level {
  double alt_m = 0.0;
  MavFrame frame = MavFrame::global;
};

/// DO_CHANGE_ALTITUDE as ArduPilot's planes know it; `before_m` is the altitude that it starts from, in the same frame.
MissionItem as_nav_change_alt(MissionItem const& change, MavFrame frame, std::optional<double> before_m) {
  float constexpr neutral = 0.0F;
  float constexpr climb = 1.0F;
  float constexpr descend = 2.0F;
  MissionItem item;
  item.command = MavCmd::nav_continue_and_change_alt;
  item.frame = frame;
  item.place.z_m = change.params[0];
  if (!before_m || *before_m == item.place.z_m) {
    item.params[0] = neutral;
  } else {
    item.params[0] = *before_m < item.place.z_m ? climb : descend;
  }
  return item;
}

/// The same for a vehicle that has no such command. ArduPilot reads latitude and longitude 0 as "here".
MissionItem as_waypoint_above(MissionItem const& change, MavFrame frame, std::optional<geo::Wgs84> last) {
  MissionItem item;
  item.command = MavCmd::nav_waypoint;
  item.frame = frame;
  item.params[3] = std::numeric_limits<float>::quiet_NaN();
  if (last) item.place = {.lat_rad = last->lat_rad, .lon_rad = last->lon_rad};
  item.place.z_m = change.params[0];
  return item;
}

/// Others are made to climb by a waypoint; what stays on the ground keeps a command that it cannot carry out.
bool climbs_by_waypoint(vehicle::Family family, bool is_ardupilot) {
  using enum vehicle::Family;
  if (is_ardupilot) return family == copter || family == sub;
  return family != rover && family != boat;
}

/// Replaces every change of altitude; `last` is where the mission starts.
void replace_altitude_changes(std::vector<MissionItem>& items, vehicle::Autopilot autopilot, vehicle::Family family,
                              std::optional<geo::Wgs84> last) {
  bool const is_ardupilot = autopilot == vehicle::Autopilot::ardupilot;
  std::optional<Level> level;
  if (last) level = Level{last->alt_m};
  for (auto& item : items) {
    if (item.command == MavCmd::do_change_altitude) {
      auto const frame = frame_of_change(item);
      if (!frame) continue;
      auto const before = std::exchange(level, Level{item.params[0], *frame});
      if (climbs_by_waypoint(family, is_ardupilot)) {
        if (is_ardupilot || last) item = as_waypoint_above(item, *frame, last);
      } else if (is_ardupilot) {
        bool const is_comparable = before && before->frame == *frame;
        item = as_nav_change_alt(item, *frame, is_comparable ? std::optional(before->alt_m) : std::nullopt);
      }
    } else if (has_position(item) && item.command != MavCmd::do_set_home) {
      last = position_of(item);
      level = Level{item.place.z_m, item.frame};
    }
  }
}

/// PX4 takes a DO_LAND_START without its place only.
bool has_frame_on_px4(MavCmd command) {
  return mavlink::has_place(command) && command != MavCmd::do_land_start;
}

}  // namespace

std::vector<MissionItem> for_autopilot(Mission const& mission, vehicle::Autopilot autopilot,
                                       std::optional<geo::Wgs84> vehicle_home, vehicle::Family family) {
  using enum vehicle::Autopilot;
  auto const home = mission.home ? mission.home : vehicle_home;
  auto items = mission.items;
  if (autopilot != other) replace_altitude_changes(items, autopilot, family, home);
  if (autopilot == ardupilot) items.insert(items.begin(), home_item(home.value_or(geo::Wgs84{})));
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto& item = items[i];
    item.seq = static_cast<std::uint16_t>(i);
    if (autopilot != ardupilot && item.command == MavCmd::do_jump) item.params[0] -= 1.0F;
    if (autopilot == px4 && !has_frame_on_px4(item.command)) item.frame = mavlink::MavFrame::mission;
  }
  return items;
}

}  // namespace lapwing::plan
