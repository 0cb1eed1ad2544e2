#include "plan/capabilities.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include <fmt/format.h>

namespace lapwing::plan {
namespace {

using mavlink::MavCmd;
using vehicle::Autopilot;
using vehicle::Family;
using enum mavlink::MavCmd;

/// Families as a set of bits. Boats run ArduPilot's rover program, VTOLs its plane program.
using Families = std::uint8_t;
Families constexpr copter = 1;
Families constexpr plane = 2;
Families constexpr vtol = 4;
Families constexpr rover = 8;
Families constexpr sub = 16;
Families constexpr wings = plane | vtol;
Families constexpr fliers = copter | wings;
Families constexpr all = fliers | rover | sub;
Families constexpr none = 0;

Families bit_of(Family family) {
  switch (family) {
    case Family::copter: return copter;
    case Family::plane: return plane;
    case Family::vtol: return vtol;
    case Family::rover:
    case Family::boat: return rover;
    case Family::sub: return sub;
    case Family::robot:  // takes no MAVLink mission
    case Family::unknown: break;
  }
  return none;
}

/// One command that ArduPilot stores: which of its vehicles carry it out, and whether PX4 takes it.
struct Row {
  MavCmd command;
  Families ardupilot;
  bool px4;
};

auto constexpr rows = std::to_array<Row>({
    {nav_waypoint, all, true},
    {nav_loiter_unlim, all, true},
    {nav_loiter_turns, all, false},
    {nav_loiter_time, all, true},
    {nav_return_to_launch, all, true},
    {nav_land, fliers | sub, true},
    {nav_takeoff, fliers, true},
    {nav_continue_and_change_alt, wings, false},
    {nav_loiter_to_alt, fliers, true},
    {nav_spline_waypoint, copter, false},
    {nav_altitude_wait, wings, false},
    {nav_vtol_takeoff, copter | vtol, true},
    {nav_vtol_land, copter | vtol, true},
    {nav_guided_enable, copter | rover | sub, false},
    {nav_delay, all, true},
    {nav_payload_place, copter | vtol, false},
    {condition_delay, all, true},
    {condition_distance, all, true},
    {condition_yaw, copter | sub, false},
    {do_jump, all, true},
    {do_change_speed, all, true},
    // PX4 takes it only without a frame, and then reads degrees in units of 1e-7 as degrees.
    {do_set_home, all, false},
    {do_set_relay, all, false},
    {do_repeat_relay, all, false},
    {do_set_servo, all, false},
    {do_repeat_servo, all, false},
    {do_return_path_start, fliers, false},
    {do_land_start, fliers, true},
    {do_go_around, none, false},
    {do_pause_continue, none, false},
    {do_set_reverse, rover, false},
    {do_set_roi_location, all, true},
    {do_set_roi_none, all, true},
    {do_set_roi, all, true},
    {do_digicam_configure, all, false},
    {do_digicam_control, all, true},
    {do_mount_control, fliers | sub, true},
    {do_set_cam_trigg_dist, all, true},
    {do_fence_enable, all, false},
    {do_parachute, fliers, false},
    {do_inverted_flight, wings, false},
    {do_gripper, all, true},
    {do_autotune_enable, wings, true},
    {nav_set_yaw_speed, rover, false},
    {do_set_resume_repeat_dist, all, false},
    {do_sprayer, all, false},
    {do_send_script_message, all, false},
    {do_aux_function, all, false},
    {do_guided_limits, copter | rover | sub, false},
    {do_engine_control, wings, false},
    {set_camera_zoom, all, false},
    {set_camera_focus, all, true},
    {set_camera_source, all, true},
    {jump_tag, all, false},
    {do_jump_tag, all, false},
    {do_gimbal_manager_pitchyaw, all, true},
    {image_start_capture, all, true},
    {image_stop_capture, all, true},
    {video_start_capture, all, true},
    {video_stop_capture, all, true},
    {do_vtol_transition, vtol, true},
    {do_winch, copter, true},
    {nav_attitude_time, copter, false},
});
static_assert(std::ranges::is_sorted(rows, {}, &Row::command));

Row const* find(MavCmd command) {
  auto const found = std::ranges::lower_bound(rows, command, {}, &Row::command);
  return found != rows.end() && found->command == command ? &*found : nullptr;
}

Handling on_ardupilot(Family family, MavCmd command) {
  // The program for planes alone refuses it; the others take it, and only the copter's flies it.
  bool const is_wing = family == Family::plane || family == Family::vtol;
  if (command == nav_spline_waypoint && is_wing) return Handling::refused;
  auto const* row = find(command);
  if (!row) return Handling::unknown;
  return (row->ardupilot & bit_of(family)) != 0 ? Handling::carried_out : Handling::skipped;
}

Handling on_px4(MavCmd command) {
  auto const* row = find(command);
  if (command == do_change_altitude) return Handling::refused;
  if (!row) return command == condition_gate ? Handling::carried_out : Handling::unknown;
  return row->px4 ? Handling::carried_out : Handling::refused;
}

/// "a rover": for people.
std::string_view noun(Family family) {
  switch (family) {
    case Family::copter: return "a copter";
    case Family::plane: return "a plane";
    case Family::vtol: return "a VTOL plane";
    case Family::rover: return "a rover";
    case Family::boat: return "a boat";
    case Family::sub: return "an underwater vehicle";
    case Family::robot: return "a robot";
    case Family::unknown: break;
  }
  return "this vehicle";
}

/// What to write instead.
std::string_view hint_for(MavCmd command) {
  switch (command) {
    case nav_takeoff: return "leave out the take-off";
    case nav_land: return "end with returnHome, or with a goPos";
    case do_change_altitude:
    case nav_continue_and_change_alt: return "leave out the altitude";
    case nav_loiter_turns: return "use a loiter for a time";
    case do_set_home: return "set home once, as the mission's first command";
    default: return "leave it out, or choose another vehicle";
  }
}

}  // namespace

Handling handling(Autopilot autopilot, Family family, MavCmd command) {
  if (family == Family::unknown) return Handling::unknown;
  switch (autopilot) {
    case Autopilot::ardupilot: return on_ardupilot(family, command);
    case Autopilot::px4: return on_px4(command);
    case Autopilot::other: break;
  }
  return Handling::unknown;
}

std::vector<Family> families_of(std::string_view vehicle_type) {
  if (vehicle_type == "UAV") return {Family::copter, Family::plane, Family::vtol};
  if (vehicle_type == "UGV") return {Family::rover};
  if (vehicle_type == "USV") return {Family::boat};
  if (vehicle_type == "UUV") return {Family::sub};
  return {};
}

std::optional<base::Error> objection(std::span<mavlink::MissionItem const> items, Autopilot autopilot, Family family) {
  for (auto const& item : items) {
    auto const how = handling(autopilot, family, item.command);
    if (how != Handling::skipped && how != Handling::refused) continue;
    auto const what = how == Handling::skipped ? "would skip it" : "refuses it";
    return base::Error{.kind = base::ErrorKind::invalid_input,
                       .message = fmt::format("item {}, {}: {} with {} {}", item.seq, to_string(item.command),
                                              noun(family), autopilot == Autopilot::px4 ? "PX4" : "ArduPilot", what),
                       .hint = std::string(hint_for(item.command))};
  }
  return std::nullopt;
}

}  // namespace lapwing::plan
