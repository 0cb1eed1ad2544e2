#include "mavlink/codec/enums.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace lapwing::mavlink {

namespace {

struct CommandTraits {
  MavCmd command;
  std::string_view name;
  bool has_place;
};

/// In the order of the numbers.
auto constexpr commands = std::to_array<CommandTraits>({
    {MavCmd::nav_waypoint, "NAV_WAYPOINT", true},
    {MavCmd::nav_loiter_unlim, "NAV_LOITER_UNLIM", true},
    {MavCmd::nav_loiter_turns, "NAV_LOITER_TURNS", true},
    {MavCmd::nav_loiter_time, "NAV_LOITER_TIME", true},
    {MavCmd::nav_return_to_launch, "NAV_RETURN_TO_LAUNCH", false},
    {MavCmd::nav_land, "NAV_LAND", true},
    {MavCmd::nav_takeoff, "NAV_TAKEOFF", true},
    {MavCmd::nav_land_local, "NAV_LAND_LOCAL", true},
    {MavCmd::nav_takeoff_local, "NAV_TAKEOFF_LOCAL", true},
    {MavCmd::nav_follow, "NAV_FOLLOW", true},
    {MavCmd::nav_continue_and_change_alt, "NAV_CONTINUE_AND_CHANGE_ALT", false},
    {MavCmd::nav_loiter_to_alt, "NAV_LOITER_TO_ALT", true},
    {MavCmd::nav_pathplanning, "NAV_PATHPLANNING", true},
    {MavCmd::nav_spline_waypoint, "NAV_SPLINE_WAYPOINT", true},
    {MavCmd::nav_altitude_wait, "NAV_ALTITUDE_WAIT", false},
    {MavCmd::nav_vtol_takeoff, "NAV_VTOL_TAKEOFF", true},
    {MavCmd::nav_vtol_land, "NAV_VTOL_LAND", true},
    {MavCmd::nav_guided_enable, "NAV_GUIDED_ENABLE", false},
    {MavCmd::nav_delay, "NAV_DELAY", false},
    {MavCmd::nav_payload_place, "NAV_PAYLOAD_PLACE", true},
    {MavCmd::condition_delay, "CONDITION_DELAY", false},
    {MavCmd::condition_change_alt, "CONDITION_CHANGE_ALT", false},
    {MavCmd::condition_distance, "CONDITION_DISTANCE", false},
    {MavCmd::condition_yaw, "CONDITION_YAW", false},
    {MavCmd::do_set_mode, "DO_SET_MODE", false},
    {MavCmd::do_jump, "DO_JUMP", false},
    {MavCmd::do_change_speed, "DO_CHANGE_SPEED", false},
    {MavCmd::do_set_home, "DO_SET_HOME", true},
    {MavCmd::do_set_relay, "DO_SET_RELAY", false},
    {MavCmd::do_repeat_relay, "DO_REPEAT_RELAY", false},
    {MavCmd::do_set_servo, "DO_SET_SERVO", false},
    {MavCmd::do_repeat_servo, "DO_REPEAT_SERVO", false},
    {MavCmd::do_flight_termination, "DO_FLIGHTTERMINATION", false},
    {MavCmd::do_change_altitude, "DO_CHANGE_ALTITUDE", false},
    {MavCmd::do_return_path_start, "DO_RETURN_PATH_START", true},
    {MavCmd::do_land_start, "DO_LAND_START", true},
    {MavCmd::do_rally_land, "DO_RALLY_LAND", false},
    {MavCmd::do_go_around, "DO_GO_AROUND", false},
    {MavCmd::do_reposition, "DO_REPOSITION", true},
    {MavCmd::do_pause_continue, "DO_PAUSE_CONTINUE", false},
    {MavCmd::do_set_reverse, "DO_SET_REVERSE", false},
    {MavCmd::do_set_roi_location, "DO_SET_ROI_LOCATION", true},
    {MavCmd::do_set_roi_none, "DO_SET_ROI_NONE", false},
    {MavCmd::do_set_roi, "DO_SET_ROI", true},
    {MavCmd::do_digicam_configure, "DO_DIGICAM_CONFIGURE", false},
    {MavCmd::do_digicam_control, "DO_DIGICAM_CONTROL", false},
    {MavCmd::do_mount_configure, "DO_MOUNT_CONFIGURE", false},
    {MavCmd::do_mount_control, "DO_MOUNT_CONTROL", false},
    {MavCmd::do_set_cam_trigg_dist, "DO_SET_CAM_TRIGG_DIST", false},
    {MavCmd::do_fence_enable, "DO_FENCE_ENABLE", false},
    {MavCmd::do_parachute, "DO_PARACHUTE", false},
    {MavCmd::do_motor_test, "DO_MOTOR_TEST", false},
    {MavCmd::do_inverted_flight, "DO_INVERTED_FLIGHT", false},
    {MavCmd::do_gripper, "DO_GRIPPER", false},
    {MavCmd::do_autotune_enable, "DO_AUTOTUNE_ENABLE", false},
    {MavCmd::nav_set_yaw_speed, "NAV_SET_YAW_SPEED", false},
    {MavCmd::do_set_resume_repeat_dist, "DO_SET_RESUME_REPEAT_DIST", false},
    {MavCmd::do_sprayer, "DO_SPRAYER", false},
    {MavCmd::do_send_script_message, "DO_SEND_SCRIPT_MESSAGE", false},
    {MavCmd::do_aux_function, "DO_AUX_FUNCTION", false},
    {MavCmd::do_guided_limits, "DO_GUIDED_LIMITS", false},
    {MavCmd::do_engine_control, "DO_ENGINE_CONTROL", false},
    {MavCmd::do_set_mission_current, "DO_SET_MISSION_CURRENT", false},
    {MavCmd::preflight_calibration, "PREFLIGHT_CALIBRATION", false},
    {MavCmd::preflight_storage, "PREFLIGHT_STORAGE", false},
    {MavCmd::preflight_reboot_shutdown, "PREFLIGHT_REBOOT_SHUTDOWN", false},
    {MavCmd::mission_start, "MISSION_START", false},
    {MavCmd::component_arm_disarm, "COMPONENT_ARM_DISARM", false},
    {MavCmd::run_prearm_checks, "RUN_PREARM_CHECKS", false},
    {MavCmd::get_home_position, "GET_HOME_POSITION", false},
    {MavCmd::get_message_interval, "GET_MESSAGE_INTERVAL", false},
    {MavCmd::set_message_interval, "SET_MESSAGE_INTERVAL", false},
    {MavCmd::request_message, "REQUEST_MESSAGE", false},
    {MavCmd::request_protocol_version, "REQUEST_PROTOCOL_VERSION", false},
    {MavCmd::request_autopilot_capabilities, "REQUEST_AUTOPILOT_CAPABILITIES", false},
    {MavCmd::set_camera_mode, "SET_CAMERA_MODE", false},
    {MavCmd::set_camera_zoom, "SET_CAMERA_ZOOM", false},
    {MavCmd::set_camera_focus, "SET_CAMERA_FOCUS", false},
    {MavCmd::set_camera_source, "SET_CAMERA_SOURCE", false},
    {MavCmd::jump_tag, "JUMP_TAG", false},
    {MavCmd::do_jump_tag, "DO_JUMP_TAG", false},
    {MavCmd::do_gimbal_manager_pitchyaw, "DO_GIMBAL_MANAGER_PITCHYAW", false},
    {MavCmd::image_start_capture, "IMAGE_START_CAPTURE", false},
    {MavCmd::image_stop_capture, "IMAGE_STOP_CAPTURE", false},
    {MavCmd::request_camera_image_capture, "REQUEST_CAMERA_IMAGE_CAPTURE", false},
    {MavCmd::video_start_capture, "VIDEO_START_CAPTURE", false},
    {MavCmd::video_stop_capture, "VIDEO_STOP_CAPTURE", false},
    {MavCmd::do_vtol_transition, "DO_VTOL_TRANSITION", false},
    {MavCmd::condition_gate, "CONDITION_GATE", true},
    {MavCmd::nav_fence_return_point, "NAV_FENCE_RETURN_POINT", true},
    {MavCmd::nav_fence_polygon_vertex_inclusion, "NAV_FENCE_POLYGON_VERTEX_INCLUSION", true},
    {MavCmd::nav_fence_polygon_vertex_exclusion, "NAV_FENCE_POLYGON_VERTEX_EXCLUSION", true},
    {MavCmd::nav_fence_circle_inclusion, "NAV_FENCE_CIRCLE_INCLUSION", true},
    {MavCmd::nav_fence_circle_exclusion, "NAV_FENCE_CIRCLE_EXCLUSION", true},
    {MavCmd::nav_rally_point, "NAV_RALLY_POINT", true},
    {MavCmd::do_winch, "DO_WINCH", false},
    {MavCmd::nav_attitude_time, "NAV_ATTITUDE_TIME", false},
});
static_assert(std::ranges::is_sorted(commands, {}, &CommandTraits::command));

CommandTraits const* find(MavCmd command) {
  auto const found = std::ranges::lower_bound(commands, command, {}, &CommandTraits::command);
  return found != commands.end() && found->command == command ? &*found : nullptr;
}

}  // namespace

std::string to_string(MavCmd command) {
  auto const* traits = find(command);
  return traits ? std::string(traits->name) : fmt::format("command {}", static_cast<int>(command));
}

bool is_listed(MavCmd command) {
  return find(command) != nullptr;
}

bool has_place(MavCmd command) {
  auto const* traits = find(command);
  return traits && traits->has_place;
}

std::string_view sensor_name(unsigned bit) {
  // MAV_SYS_STATUS_SENSOR, bit by bit.
  static constexpr auto names = std::to_array<std::string_view>({"gyro",
                                                                 "accelerometer",
                                                                 "compass",
                                                                 "barometer",
                                                                 "airspeed sensor",
                                                                 "GPS",
                                                                 "optical flow",
                                                                 "vision",
                                                                 "laser position",
                                                                 "ground truth",
                                                                 "rate control",
                                                                 "attitude control",
                                                                 "yaw control",
                                                                 "height control",
                                                                 "position control",
                                                                 "motor outputs",
                                                                 "RC receiver",
                                                                 "second gyro",
                                                                 "second accelerometer",
                                                                 "second compass",
                                                                 "fence",
                                                                 "attitude estimate",
                                                                 "terrain data",
                                                                 "reversed motor",
                                                                 "logging",
                                                                 "battery",
                                                                 "proximity sensor",
                                                                 "satellite link",
                                                                 "arming checks",
                                                                 "obstacle avoidance",
                                                                 "propulsion"});
  return bit < names.size() ? names[bit] : "";
}

bool is_global(MavFrame frame) {
  switch (frame) {
    case MavFrame::global:
    case MavFrame::global_relative_alt:
    case MavFrame::global_int:
    case MavFrame::global_relative_alt_int:
    case MavFrame::global_terrain_alt:
    case MavFrame::global_terrain_alt_int: return true;
    default: return false;
  }
}

std::string to_string(MavResult result) {
  switch (result) {
    case MavResult::accepted: return "accepted";
    case MavResult::temporarily_rejected: return "temporarily rejected";
    case MavResult::denied: return "denied";
    case MavResult::unsupported: return "unsupported";
    case MavResult::failed: return "failed";
    case MavResult::in_progress: return "in progress";
    case MavResult::cancelled: return "cancelled";
    case MavResult::command_long_only: return "only accepted as COMMAND_LONG";
    case MavResult::command_int_only: return "only accepted as COMMAND_INT";
    case MavResult::command_unsupported_mav_frame: return "frame unsupported";
  }
  return fmt::format("result {}", static_cast<int>(result));
}

std::string to_string(MavMissionResult result) {
  switch (result) {
    case MavMissionResult::accepted: return "accepted";
    case MavMissionResult::error: return "unspecified error";
    case MavMissionResult::unsupported_frame: return "coordinate frame not supported";
    case MavMissionResult::unsupported: return "command not supported";
    case MavMissionResult::no_space: return "no space left for items";
    case MavMissionResult::invalid: return "invalid parameter";
    case MavMissionResult::invalid_param1: return "invalid parameter 1";
    case MavMissionResult::invalid_param2: return "invalid parameter 2";
    case MavMissionResult::invalid_param3: return "invalid parameter 3";
    case MavMissionResult::invalid_param4: return "invalid parameter 4";
    case MavMissionResult::invalid_param5_x: return "invalid latitude or parameter 5";
    case MavMissionResult::invalid_param6_y: return "invalid longitude or parameter 6";
    case MavMissionResult::invalid_param7: return "invalid altitude or parameter 7";
    case MavMissionResult::invalid_sequence: return "item out of sequence";
    case MavMissionResult::denied: return "denied (another transfer may be under way)";
    case MavMissionResult::operation_cancelled: return "transfer cancelled by the vehicle";
  }
  return fmt::format("result {}", static_cast<int>(result));
}

std::string to_string(MavParamError error) {
  switch (error) {
    case MavParamError::no_error: return "no error";
    case MavParamError::does_not_exist: return "there is no such parameter";
    case MavParamError::value_out_of_range: return "the value is out of range";
    case MavParamError::permission_denied: return "permission denied";
    case MavParamError::component_not_found: return "there is no such component";
    case MavParamError::read_only: return "it is read-only";
    case MavParamError::type_unsupported: return "its type is not supported";
    case MavParamError::type_mismatch: return "it has another type";
    case MavParamError::read_fail: return "it could not be read";
  }
  return fmt::format("error {}", static_cast<int>(error));
}

}  // namespace lapwing::mavlink
