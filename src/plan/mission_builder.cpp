#include "plan/mission_builder.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace lapwing::plan {
namespace {

using base::ErrorKind;
using base::fail;
using base::Result;
using mavlink::MavCmd;

Result<> check_place(geo::Wgs84 place) {
  bool const is_finite = std::isfinite(place.lat_rad) && std::isfinite(place.lon_rad) && std::isfinite(place.alt_m);
  if (!is_finite) return fail(ErrorKind::invalid_input, "a position has a coordinate that is no number");
  if (std::abs(place.lat_rad) > std::numbers::pi / 2.0) {
    return fail(ErrorKind::invalid_input, fmt::format("latitude {} is beyond 90 degrees", place.lat_deg()));
  }
  if (std::abs(place.lon_rad) > std::numbers::pi) {
    return fail(ErrorKind::invalid_input, fmt::format("longitude {} is beyond 180 degrees", place.lon_deg()));
  }
  double constexpr highest_m = 83000.0;  // ArduPilot's LOCATION_ALT_MAX_M
  if (std::abs(place.alt_m) >= highest_m) {
    return fail(ErrorKind::invalid_input, fmt::format("an altitude of {} m is beyond 83 km", place.alt_m));
  }
  return {};
}

// What ArduPilot keeps of an item's numbers (AP_Mission::mavlink_int_to_mission_cmd); more would wrap round or be cut.
double constexpr max_turns = 255.0;
double constexpr max_circles_radius_m = 2550.0;
double constexpr max_radius_m = 65535.0;
double constexpr max_loiter_s = 65535.0;
double constexpr max_photos = 65535.0;
double constexpr max_jumps = 32767.0;
/// A way longer than this is a slip of the pen, and bends the level frame it is measured in.
double constexpr max_offset_m = 1e6;

Result<> check_between(std::string_view what, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  if (std::isnan(value)) return fail(ErrorKind::invalid_input, fmt::format("{} must be a number", what));
  auto const bound = value > most ? fmt::format("at most {}", most) : fmt::format("{} or more", least);
  return fail(ErrorKind::invalid_input, fmt::format("{} must be {}, not {}", what, bound, value));
}

Result<geo::Wgs84> displaced_from(std::optional<geo::Wgs84> base, Offset offset, char const* without_base) {
  if (!base) return fail(ErrorKind::invalid_input, without_base, "give the mission a `home` first");
  if (std::hypot(offset.north_m, offset.east_m) > max_offset_m) {
    return fail(
        ErrorKind::invalid_input,
        fmt::format("{} m north and {} m east are too far away for a relative move", offset.north_m, offset.east_m),
        "at most 1000 km; goPos goes to coordinates");
  }
  // Exactly the base, not a rounding away from it: returning home lands at home.
  if (offset.north_m == 0.0 && offset.east_m == 0.0) {
    return geo::Wgs84{base->lat_rad, base->lon_rad, base->alt_m + offset.up_m};
  }
  return geo::displaced(*base, {.north = offset.north_m, .east = offset.east_m, .down = -offset.up_m});
}

}  // namespace

Result<> MissionBuilder::add(MavCmd command, std::array<double, 4> params, std::optional<geo::Wgs84> place) {
  if (mission_.items.size() + 1 >= max_mission_items) {  // one place is home's
    return fail(ErrorKind::invalid_input, fmt::format("a mission can hold at most {} items", max_mission_items));
  }
  // Only the fourth, a yaw, may be left to the vehicle.
  if (!std::all_of(params.begin(), params.end() - 1, [](double value) { return std::isfinite(value); })) {
    return fail(ErrorKind::invalid_input, "an argument is no number");
  }
  mavlink::MissionItem item;
  item.command = command;
  std::ranges::transform(params, item.params.begin(), [](double value) { return static_cast<float>(value); });
  if (place) {
    if (auto checked = check_place(*place); !checked) return checked;
    item.place = {.lat_rad = place->lat_rad, .lon_rad = place->lon_rad, .z_m = place->alt_m};
    if (command != MavCmd::do_set_home) last_ = place;
  }
  mission_.items.push_back(item);
  return {};
}

Result<> MissionBuilder::home(geo::Wgs84 place) {
  if (auto checked = check_place(place); !checked) return checked;
  bool const is_first = mission_.items.empty() && !mission_.home;
  home_ = place;
  if (!last_) last_ = place;
  if (!is_first) return add(MavCmd::do_set_home, {}, place);
  mission_.home = place;
  return {};
}

Result<geo::Wgs84> MissionBuilder::from_last(Offset offset) const {
  return displaced_from(last_, offset, "relative move without home or earlier position");
}

Result<geo::Wgs84> MissionBuilder::from_home(Offset offset) const {
  return displaced_from(home_, offset, "the mission has no home to start from or return to");
}

Result<> MissionBuilder::waypoint(geo::Wgs84 place, double acceptance_radius_m) {
  return add(MavCmd::nav_waypoint, {0.0, acceptance_radius_m, 0.0, free_yaw}, place);
}

Result<> MissionBuilder::take_off(geo::Wgs84 place, double pitch_deg, double yaw_deg) {
  if (auto checked = check_between("the pitch of a take-off", pitch_deg, 0.0, 90.0); !checked) return checked;
  return add(MavCmd::nav_takeoff, {pitch_deg, 0.0, 0.0, yaw_deg}, place);
}

Result<> MissionBuilder::loiter(geo::Wgs84 place, Loiter loiter) {
  using enum Loiter::Kind;
  auto const what = loiter.kind == turns ? "the number of turns" : "the loiter time";
  double const most = loiter.kind == turns ? max_turns : max_loiter_s;
  if (auto checked = check_between(what, loiter.amount, 0.0, most); !checked) return checked;
  double const widest_m = loiter.kind == turns ? max_circles_radius_m : max_radius_m;
  if (auto checked = check_between("the radius", std::abs(loiter.radius_m), 0.0, widest_m); !checked) return checked;
  auto const command = loiter.kind == unlimited ? MavCmd::nav_loiter_unlim
                       : loiter.kind == turns   ? MavCmd::nav_loiter_turns
                                                : MavCmd::nav_loiter_time;
  return add(command, {loiter.amount, 0.0, loiter.radius_m, 0.0}, place);
}

Result<> MissionBuilder::land(geo::Wgs84 place, double yaw_deg, int precision_mode) {
  if (precision_mode < 0 || precision_mode > 2) {
    return fail(ErrorKind::invalid_input, fmt::format("there is no precision land mode {}", precision_mode),
                "0 is off, 1 opportunistic, 2 required");
  }
  return add(MavCmd::nav_land, {0.0, static_cast<double>(precision_mode), 0.0, yaw_deg}, place);
}

Result<> MissionBuilder::survey(SurveyArea const& area) {
  auto const path = survey_path(area);
  if (!path) return std::unexpected(path.error());
  if (mission_.items.size() + path->size() >= max_mission_items) {
    return fail(ErrorKind::invalid_input, fmt::format("a mission can hold at most {} items", max_mission_items));
  }
  double constexpr acceptance_radius_m = 25.0;
  for (auto const& place : *path) {
    if (auto added = waypoint(place, acceptance_radius_m); !added) return added;
  }
  return {};
}

Result<> MissionBuilder::change_speed(double speed_m_s, int type) {
  if (type < 0 || type > 3) {
    return fail(ErrorKind::invalid_input, fmt::format("there is no speed type {}", type),
                "0 is air speed, 1 ground speed, 2 climb, 3 descent");
  }
  if (!(speed_m_s > 0.0) || !std::isfinite(speed_m_s)) {
    return fail(ErrorKind::invalid_input, fmt::format("a speed must be above 0, not {} m/s", speed_m_s));
  }
  double constexpr throttle_unchanged = -1.0;
  return add(MavCmd::do_change_speed, {static_cast<double>(type), speed_m_s, throttle_unchanged, 0.0});
}

Result<> MissionBuilder::change_altitude(double alt_m) {
  if (!std::isfinite(alt_m)) return fail(ErrorKind::invalid_input, "an altitude must be a number");
  if (auto checked = check_place({.alt_m = alt_m}); !checked) return checked;
  auto added = add(MavCmd::do_change_altitude, {alt_m, 0.0, 0.0, 0.0});
  if (added && last_) last_->alt_m = alt_m;
  return added;
}

Result<> MissionBuilder::delay(double seconds) {
  double constexpr longest_s = 1e6;
  if (auto checked = check_between("a delay", seconds, 0.0, longest_s); !checked) return checked;
  double constexpr no_time_of_day = -1.0;
  return add(MavCmd::nav_delay, {seconds, no_time_of_day, no_time_of_day, no_time_of_day});
}

Result<> MissionBuilder::capture_photo() {
  // A sequence number above 0 keeps the camera from taking a repeated command for a second photo.
  auto added = add(MavCmd::image_start_capture, {0.0, 0.0, 1.0, static_cast<double>(photos_ + 1)});
  if (added) ++photos_;
  return added;
}

Result<> MissionBuilder::capture_photos(int count, double interval_s) {
  if (auto checked = check_between("the number of photos", count, 0.0, max_photos); !checked) return checked;
  if (!(interval_s > 0.0) || !std::isfinite(interval_s)) {
    return fail(ErrorKind::invalid_input, fmt::format("the time between photos must be above 0, not {} s", interval_s));
  }
  return add(MavCmd::image_start_capture, {0.0, interval_s, static_cast<double>(count), 0.0});
}

Result<> MissionBuilder::stop_capture() {
  return add(MavCmd::image_stop_capture, {});
}

Result<> MissionBuilder::jump(int item, int repetitions) {
  if (item < 1) {
    return fail(ErrorKind::invalid_input, fmt::format("cannot jump to item {}", item), "items count from 1; 0 is home");
  }
  if (repetitions < -1) {
    return fail(ErrorKind::invalid_input, fmt::format("cannot jump {} times", repetitions), "-1 means for ever");
  }
  if (auto checked = check_between("the number of jumps", repetitions, -1.0, max_jumps); !checked) return checked;
  return add(MavCmd::do_jump, {static_cast<double>(item), static_cast<double>(repetitions), 0.0, 0.0});
}

Result<Mission> MissionBuilder::finish(std::string default_name) const {
  auto mission = mission_;
  if (mission.name.empty()) mission.name = std::move(default_name);
  for (auto const& item : mission.items) {
    if (item.command != MavCmd::do_jump) continue;
    if (static_cast<std::size_t>(item.params[0]) > mission.items.size()) {
      return fail(ErrorKind::invalid_input,
                  fmt::format("jumpToItem {}: the mission has items 1 to {}", item.params[0], mission.items.size()));
    }
  }
  return mission;
}

}  // namespace lapwing::plan
