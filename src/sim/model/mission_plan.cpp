#include "sim/model/mission_plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "plan/capabilities.hpp"

namespace lapwing::sim {

using mavlink::MavCmd;
using mavlink::MavFrame;
using mavlink::MavMissionResult;

namespace {

enum class Role { navigation, between };
struct Row {
  MavCmd command;
  std::string_view name;
  Role role;
};

// Commands that are simulated, with the names that AP_Mission uses in texts such as "Mission: 3 WP".
constexpr std::array rows{
    Row{MavCmd::nav_waypoint, "WP", Role::navigation},
    Row{MavCmd::nav_loiter_unlim, "LoitUnlim", Role::navigation},
    Row{MavCmd::nav_loiter_turns, "LoitTurns", Role::navigation},
    Row{MavCmd::nav_loiter_time, "LoitTime", Role::navigation},
    Row{MavCmd::nav_return_to_launch, "RTL", Role::navigation},
    Row{MavCmd::nav_land, "Land", Role::navigation},
    Row{MavCmd::nav_takeoff, "Takeoff", Role::navigation},
    Row{MavCmd::nav_continue_and_change_alt, "ContinueAndChangeAlt", Role::navigation},
    Row{MavCmd::nav_loiter_to_alt, "LoitAltitude", Role::navigation},
    Row{MavCmd::nav_spline_waypoint, "SplineWP", Role::navigation},
    Row{MavCmd::nav_guided_enable, "GuidedEnable", Role::navigation},
    Row{MavCmd::nav_delay, "Delay", Role::navigation},
    Row{MavCmd::condition_delay, "CondDelay", Role::between},
    Row{MavCmd::condition_distance, "CondDistance", Role::between},
    Row{MavCmd::condition_yaw, "CondYaw", Role::between},
    Row{MavCmd::do_jump, "Jump", Role::between},
    Row{MavCmd::do_change_speed, "SetSpeed", Role::between},
    Row{MavCmd::do_set_home, "SetHome", Role::between},
    Row{MavCmd::do_set_relay, "SetRelay", Role::between},
    Row{MavCmd::do_repeat_relay, "RepeatRelay", Role::between},
    Row{MavCmd::do_set_servo, "SetServo", Role::between},
    Row{MavCmd::do_repeat_servo, "RepeatServo", Role::between},
    Row{MavCmd::do_land_start, "LandStart", Role::between},
    Row{MavCmd::do_set_reverse, "SetReverse", Role::between},
    Row{MavCmd::do_set_roi_location, "SetROI", Role::between},
    Row{MavCmd::do_set_roi_none, "SetROI", Role::between},
    Row{MavCmd::do_set_roi, "SetROI", Role::between},
    Row{MavCmd::do_digicam_configure, "DigiCamCfg", Role::between},
    Row{MavCmd::do_digicam_control, "DigiCamCtrl", Role::between},
    Row{MavCmd::do_mount_control, "MountControl", Role::between},
    Row{MavCmd::do_set_cam_trigg_dist, "SetCamTrigDst", Role::between},
    Row{MavCmd::do_fence_enable, "FenceEnable", Role::between},
    Row{MavCmd::do_gripper, "Gripper", Role::between},
    Row{MavCmd::do_autotune_enable, "AutoTuneEnable", Role::between},
    Row{MavCmd::image_start_capture, "ImageStartCapture", Role::between},
    Row{MavCmd::image_stop_capture, "ImageStopCapture", Role::between},
};

Row const* find(MavCmd command) {
  auto const found = std::ranges::find(rows, command, &Row::command);
  return found == rows.end() ? nullptr : &*found;
}

MavFrame folded(MavFrame frame) {
  if (frame == MavFrame::global_int) return MavFrame::global;
  if (frame == MavFrame::global_relative_alt_int) return MavFrame::global_relative_alt;
  if (frame == MavFrame::global_terrain_alt_int) return MavFrame::global_terrain_alt;
  return frame;
}

}  // namespace

bool is_navigation(MavCmd command) {
  constexpr int last_navigation_command = 95;  // AP_Mission::is_nav_cmd
  return std::to_underlying(command) <= last_navigation_command || command == MavCmd::nav_set_yaw_speed ||
         command == MavCmd::nav_attitude_time;
}

bool can_fly(vehicle::Family family, MavCmd command) {
  auto const* row = find(command);
  if (!row || row->role != Role::navigation) return false;
  return plan::handling(vehicle::Autopilot::ardupilot, family, command) == plan::Handling::carried_out;
}

std::string_view short_name(MavCmd command) {
  auto const* row = find(command);
  return row ? row->name : "Unknown";
}

geo::Ned point_of(mavlink::MissionItem const& item, Site const& site, geo::Ned home, geo::Ned here) {
  auto const& place = item.place;
  geo::Ned point = here;
  if (place.lat_rad != 0.0 || place.lon_rad != 0.0) {
    point = site.ned_from({place.lat_rad, place.lon_rad, site.anchor().alt_m});
  }
  switch (folded(item.frame)) {
    case MavFrame::global: point.down = site.anchor().alt_m - place.z_m; break;
    case MavFrame::global_terrain_alt: point.down = -place.z_m; break;
    default: point.down = home.down - place.z_m;
  }
  return point;
}

bool same_item(mavlink::MissionItem const& a, mavlink::MissionItem const& b) {
  return a.command == b.command && a.frame == b.frame && a.params == b.params && a.place.lat_rad == b.place.lat_rad &&
         a.place.lon_rad == b.place.lon_rad && a.place.z_m == b.place.z_m;
}

mavlink::MissionItem normalised(mavlink::MissionItem item) {
  // Change-of-height has no place but keeps its frame, since its altitude counts.
  bool const keeps_frame = mavlink::has_place(item.command) || item.command == MavCmd::nav_continue_and_change_alt;
  item.frame = keeps_frame && item.frame != MavFrame::mission ? folded(item.frame) : MavFrame::global;
  item.current = 0;
  item.autocontinue = true;
  item.target = {};
  item.form = mavlink::ItemForm::integer;
  item.place.z_m = std::trunc(static_cast<float>(item.place.z_m) * 100.0F) / 100.0;
  auto& p = item.params;
  for (auto& value : p) {
    if (std::isnan(value)) value = 0.0F;
  }
  using enum MavCmd;
  switch (item.command) {
    case nav_waypoint: p = {std::trunc(p[0]), 0.0F, 0.0F, 0.0F}; break;
    case nav_loiter_time: p = {std::trunc(p[0]), 0.0F, 1.0F, 0.0F}; break;
    case nav_loiter_turns: p[0] = std::trunc(p[0]); break;
    case nav_land: p[3] = 1.0F; break;
    default: break;
  }
  return item;
}

std::uint16_t wire_seq(Kind const& kind, int index) {
  return static_cast<std::uint16_t>(kind.is_px4() ? std::max(index - 1, 0) : index);
}

int plan_index(Kind const& kind, int seq) {
  return kind.is_px4() ? seq + 1 : seq;
}

namespace {

bool may_leave_yaw(MavCmd command) {
  using enum MavCmd;
  switch (command) {
    case nav_waypoint:
    case nav_loiter_unlim:
    case nav_takeoff:
    case nav_land:
    case nav_vtol_takeoff:
    case nav_vtol_land: return true;
    default: return false;
  }
}

/// As AP_Mission::sanity_check_params: only a yaw may be left to the vehicle.
MavMissionResult check_params(mavlink::MissionItem const& item) {
  for (std::size_t i = 0; i < item.params.size(); ++i) {
    float const value = item.params[i];
    bool const may_be_nan = i == 3 && may_leave_yaw(item.command);
    if (std::isinf(value) || (std::isnan(value) && !may_be_nan))
      return static_cast<MavMissionResult>(std::to_underlying(MavMissionResult::invalid_param1) + i);
  }
  return MavMissionResult::accepted;
}

MavMissionResult check_place(mavlink::MissionItem const& item) {
  constexpr double highest_m = 83000.0;  // LOCATION_ALT_MAX_M
  if (!(std::abs(item.place.lat_rad) <= std::numbers::pi / 2.0)) return MavMissionResult::invalid_param5_x;
  if (!(std::abs(item.place.lon_rad) <= std::numbers::pi)) return MavMissionResult::invalid_param6_y;
  if (!(std::abs(item.place.z_m) < highest_m)) return MavMissionResult::invalid_param7;
  return MavMissionResult::accepted;
}

}  // namespace

MavMissionResult refusal(mavlink::MissionItem const& item, Kind const& kind, int total) {
  auto const checked = kind.is_px4() ? MavMissionResult::accepted : check_params(item);
  if (checked != MavMissionResult::accepted) return checked;
  auto const how = plan::handling(kind.firmware, kind.family, item.command);
  if (how != plan::Handling::carried_out && how != plan::Handling::skipped) return MavMissionResult::unsupported;
  if (item.command == MavCmd::do_jump &&
      !(item.params[0] >= (kind.is_px4() ? 0.0F : 1.0F) && item.params[0] < static_cast<float>(total)))
    return MavMissionResult::error;
  if (!mavlink::has_place(item.command)) return MavMissionResult::accepted;
  if (item.frame != MavFrame::mission && !mavlink::is_global(item.frame)) return MavMissionResult::unsupported_frame;
  return check_place(item);
}

}  // namespace lapwing::sim
