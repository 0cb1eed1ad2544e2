#pragma once

#include <cstdint>
#include <string>
#include <string_view>

/// The protocol's enumerations, with the names of the MAVLink standard (https://mavlink.io/en/messages/common.html) in
/// this project's spelling. Every one has a fixed underlying type, so a value that is not listed here survives decoding
/// and encoding.
namespace lapwing::mavlink {

/// System and component id: who sends, or who is meant. 0 means everybody.
struct Address {
  std::uint8_t system = 0;
  std::uint8_t component = 0;
  friend constexpr auto operator<=>(Address const&, Address const&) = default;
};

inline constexpr std::uint8_t autopilot_component = 1;  ///< MAV_COMP_ID_AUTOPILOT1

/// Whether a message meant for `target` concerns `self`; zeros in `target` mean everybody.
[[nodiscard]] constexpr bool addresses(Address target, Address self) {
  return (target.system == 0 || target.system == self.system) &&
         (target.component == 0 || target.component == self.component);
}

enum class MavType : std::uint8_t {
  generic = 0,
  fixed_wing = 1,
  quadrotor = 2,
  coaxial = 3,
  helicopter = 4,
  antenna_tracker = 5,
  gcs = 6,
  airship = 7,
  free_balloon = 8,
  rocket = 9,
  ground_rover = 10,
  surface_boat = 11,
  submarine = 12,
  hexarotor = 13,
  octorotor = 14,
  tricopter = 15,
  flapping_wing = 16,
  kite = 17,
  onboard_controller = 18,
  vtol_tailsitter_duorotor = 19,
  vtol_tailsitter_quadrotor = 20,
  vtol_tiltrotor = 21,
  vtol_fixedrotor = 22,
  vtol_tailsitter = 23,
  vtol_tiltwing = 24,
  vtol_reserved5 = 25,
  gimbal = 26,
  adsb = 27,
  parafoil = 28,
  dodecarotor = 29,
  camera = 30,
  charging_station = 31,
  decarotor = 35,
};

enum class MavAutopilot : std::uint8_t { generic = 0, ardupilotmega = 3, invalid = 8, px4 = 12 };

enum class MavState : std::uint8_t {
  uninit = 0,
  boot = 1,
  calibrating = 2,
  standby = 3,
  active = 4,
  critical = 5,
  emergency = 6,
  poweroff = 7,
  flight_termination = 8,
};

/// Bits of Heartbeat::base_mode.
namespace mode_flag {
inline constexpr std::uint8_t custom_mode_enabled = 0x01;
inline constexpr std::uint8_t auto_enabled = 0x04;
inline constexpr std::uint8_t guided_enabled = 0x08;
inline constexpr std::uint8_t stabilize_enabled = 0x10;
inline constexpr std::uint8_t hil_enabled = 0x20;
inline constexpr std::uint8_t manual_input_enabled = 0x40;
inline constexpr std::uint8_t safety_armed = 0x80;
}  // namespace mode_flag

/// Bits of EkfStatusReport::flags.
namespace ekf_flag {
inline constexpr std::uint16_t attitude = 0x0001;
inline constexpr std::uint16_t velocity_horizontal = 0x0002;
inline constexpr std::uint16_t velocity_vertical = 0x0004;
inline constexpr std::uint16_t position_horizontal_relative = 0x0008;
inline constexpr std::uint16_t position_horizontal_absolute = 0x0010;
inline constexpr std::uint16_t position_vertical_absolute = 0x0020;
inline constexpr std::uint16_t position_vertical_above_ground = 0x0040;
inline constexpr std::uint16_t constant_position_mode = 0x0080;
inline constexpr std::uint16_t predicted_position_horizontal_relative = 0x0100;
inline constexpr std::uint16_t predicted_position_horizontal_absolute = 0x0200;
inline constexpr std::uint16_t uninitialized = 0x0400;
}  // namespace ekf_flag

/// Bits of SysStatus::sensors_*.
namespace sensor_flag {
inline constexpr std::uint32_t gps = 1U << 5U;
inline constexpr std::uint32_t motor_outputs = 1U << 15U;
inline constexpr std::uint32_t rc_receiver = 1U << 16U;
inline constexpr std::uint32_t geofence = 1U << 20U;
inline constexpr std::uint32_t ahrs = 1U << 21U;
inline constexpr std::uint32_t battery = 1U << 25U;
inline constexpr std::uint32_t prearm_check = 1U << 28U;
}  // namespace sensor_flag

/// What the bit says is sick, for people: "compass". Empty for a bit that has no name.
[[nodiscard]] std::string_view sensor_name(unsigned bit);

/// Bits of GimbalDeviceAttitudeStatus::flags.
namespace gimbal_flag {
inline constexpr std::uint16_t yaw_lock = 1U << 4U;  ///< yaw is from north, unless one of the next two says otherwise
inline constexpr std::uint16_t yaw_in_vehicle_frame = 1U << 5U;
inline constexpr std::uint16_t yaw_in_earth_frame = 1U << 6U;
}  // namespace gimbal_flag

enum class MavFrame : std::uint8_t {
  global = 0,
  local_ned = 1,
  mission = 2,  ///< the item has no place
  global_relative_alt = 3,
  local_enu = 4,
  global_int = 5,
  global_relative_alt_int = 6,
  local_offset_ned = 7,
  body_ned = 8,
  body_offset_ned = 9,
  global_terrain_alt = 10,
  global_terrain_alt_int = 11,
  body_frd = 12,
};
/// Whether x and y of this frame are latitude and longitude.
[[nodiscard]] bool is_global(MavFrame frame);

enum class MavCmd : std::uint16_t {
  nav_waypoint = 16,
  nav_loiter_unlim = 17,
  nav_loiter_turns = 18,
  nav_loiter_time = 19,
  nav_return_to_launch = 20,
  nav_land = 21,
  nav_takeoff = 22,
  nav_land_local = 23,
  nav_takeoff_local = 24,
  nav_follow = 25,
  nav_continue_and_change_alt = 30,
  nav_loiter_to_alt = 31,
  nav_pathplanning = 81,
  nav_spline_waypoint = 82,
  nav_altitude_wait = 83,
  nav_vtol_takeoff = 84,
  nav_vtol_land = 85,
  nav_guided_enable = 92,
  nav_delay = 93,
  nav_payload_place = 94,
  condition_delay = 112,
  condition_change_alt = 113,
  condition_distance = 114,
  condition_yaw = 115,
  do_set_mode = 176,
  do_jump = 177,
  do_change_speed = 178,
  do_set_home = 179,
  do_set_relay = 181,
  do_repeat_relay = 182,
  do_set_servo = 183,
  do_repeat_servo = 184,
  do_flight_termination = 185,
  do_change_altitude = 186,
  do_return_path_start = 188,
  do_land_start = 189,
  do_rally_land = 190,
  do_go_around = 191,
  do_reposition = 192,
  do_pause_continue = 193,
  do_set_reverse = 194,
  do_set_roi_location = 195,
  do_set_roi_none = 197,
  do_set_roi = 201,
  do_digicam_configure = 202,
  do_digicam_control = 203,
  do_mount_configure = 204,
  do_mount_control = 205,
  do_set_cam_trigg_dist = 206,
  do_fence_enable = 207,
  do_parachute = 208,
  do_motor_test = 209,
  do_inverted_flight = 210,
  do_gripper = 211,
  do_autotune_enable = 212,
  nav_set_yaw_speed = 213,
  do_set_resume_repeat_dist = 215,
  do_sprayer = 216,
  do_send_script_message = 217,
  do_aux_function = 218,
  do_guided_limits = 222,
  do_engine_control = 223,
  do_set_mission_current = 224,
  preflight_calibration = 241,
  preflight_storage = 245,
  preflight_reboot_shutdown = 246,
  mission_start = 300,
  component_arm_disarm = 400,
  run_prearm_checks = 401,
  get_home_position = 410,
  get_message_interval = 510,
  set_message_interval = 511,
  request_message = 512,
  request_protocol_version = 519,
  request_autopilot_capabilities = 520,
  set_camera_mode = 530,
  set_camera_zoom = 531,
  set_camera_focus = 532,
  set_camera_source = 534,
  jump_tag = 600,
  do_jump_tag = 601,
  do_gimbal_manager_pitchyaw = 1000,
  image_start_capture = 2000,
  image_stop_capture = 2001,
  request_camera_image_capture = 2002,
  video_start_capture = 2500,
  video_stop_capture = 2501,
  do_vtol_transition = 3000,
  condition_gate = 4501,
  nav_fence_return_point = 5000,
  nav_fence_polygon_vertex_inclusion = 5001,
  nav_fence_polygon_vertex_exclusion = 5002,
  nav_fence_circle_inclusion = 5003,
  nav_fence_circle_exclusion = 5004,
  nav_rally_point = 5100,
  do_winch = 42600,
  nav_attitude_time = 42703,
};
/// "NAV_WAYPOINT", or "command 12345" for one that is not listed.
[[nodiscard]] std::string to_string(MavCmd command);
/// Whether it is one of the enumerators, so that `has_place` knows.
[[nodiscard]] bool is_listed(MavCmd command);
/// Whether parameters 5 and 6 of the command are a latitude and a longitude (in a global frame).
[[nodiscard]] bool has_place(MavCmd command);

enum class MavResult : std::uint8_t {
  accepted = 0,
  temporarily_rejected = 1,
  denied = 2,
  unsupported = 3,
  failed = 4,
  in_progress = 5,
  cancelled = 6,
  command_long_only = 7,
  command_int_only = 8,
  command_unsupported_mav_frame = 9,
};
/// "denied", "temporarily rejected" ...: the standard's word, for people.
[[nodiscard]] std::string to_string(MavResult result);

enum class MavMissionResult : std::uint8_t {
  accepted = 0,
  error = 1,
  unsupported_frame = 2,
  unsupported = 3,
  no_space = 4,
  invalid = 5,
  invalid_param1 = 6,
  invalid_param2 = 7,
  invalid_param3 = 8,
  invalid_param4 = 9,
  invalid_param5_x = 10,
  invalid_param6_y = 11,
  invalid_param7 = 12,
  invalid_sequence = 13,
  denied = 14,
  operation_cancelled = 15,
};
/// "the command is not supported", "no space left" ...: for people.
[[nodiscard]] std::string to_string(MavMissionResult result);

enum class MissionType : std::uint8_t { mission = 0, fence = 1, rally = 2, all = 255 };

enum class MissionState : std::uint8_t {
  unknown = 0,
  no_mission = 1,
  not_started = 2,
  active = 3,
  paused = 4,
  complete = 5,
};

enum class MavSeverity : std::uint8_t {
  emergency = 0,
  alert = 1,
  critical = 2,
  error = 3,
  warning = 4,
  notice = 5,
  info = 6,
  debug = 7,
};

enum class MavLandedState : std::uint8_t { undefined = 0, on_ground = 1, in_air = 2, takeoff = 3, landing = 4 };

enum class MavVtolState : std::uint8_t {
  undefined = 0,
  transition_to_fixed_wing = 1,
  transition_to_multicopter = 2,
  multicopter = 3,
  fixed_wing = 4,
};

enum class GpsFix : std::uint8_t {
  no_gps = 0,
  no_fix = 1,
  fix_2d = 2,
  fix_3d = 3,
  dgps = 4,
  rtk_float = 5,
  rtk_fixed = 6,
  fixed_position = 7,
  ppp = 8,
};

enum class MavParamType : std::uint8_t {
  uint8 = 1,
  int8 = 2,
  uint16 = 3,
  int16 = 4,
  uint32 = 5,
  int32 = 6,
  uint64 = 7,
  int64 = 8,
  real32 = 9,
  real64 = 10,
};

enum class MavParamError : std::uint8_t {
  no_error = 0,
  does_not_exist = 1,
  value_out_of_range = 2,
  permission_denied = 3,
  component_not_found = 4,
  read_only = 5,
  type_unsupported = 6,
  type_mismatch = 7,
  read_fail = 8,
};
/// "there is no such parameter", "it is read-only" ...: for people.
[[nodiscard]] std::string to_string(MavParamError error);

/// Bits of AutopilotVersion::capabilities.
namespace capability_flag {
inline constexpr std::uint64_t param_encode_bytewise = 1ULL << 4U;
inline constexpr std::uint64_t param_encode_c_cast = 1ULL << 17U;
}  // namespace capability_flag

/// Message ids that are asked for by number (message intervals, REQUEST_MESSAGE).
enum class MessageId : std::uint32_t {
  heartbeat = 0,
  sys_status = 1,
  system_time = 2,
  gps_raw_int = 24,
  attitude = 30,
  local_position_ned = 32,
  global_position_int = 33,
  mission_current = 42,
  gps_global_origin = 49,
  nav_controller_output = 62,
  rc_channels = 65,
  vfr_hud = 74,
  radio_status = 109,
  timesync = 111,
  camera_trigger = 112,
  distance_sensor = 132,
  battery_status = 147,
  autopilot_version = 148,
  mount_status = 158,
  fence_status = 162,
  wind = 168,
  camera_feedback = 180,
  ekf_status_report = 193,
  estimator_status = 230,
  wind_cov = 231,
  home_position = 242,
  message_interval = 244,
  extended_sys_state = 245,
  statustext = 253,
  camera_information = 259,
  camera_image_captured = 263,
  gimbal_manager_information = 280,
  gimbal_device_attitude_status = 285,
  protocol_version = 300,
  obstacle_distance = 330,
  available_modes = 435,
  current_mode = 436,
  available_modes_monitor = 437,
};

}  // namespace lapwing::mavlink
