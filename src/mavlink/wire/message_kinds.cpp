#include "mavlink/wire/message_kinds.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace lapwing::mavlink::internal {

namespace {

// All in ascending order.
auto constexpr bulk_ids = std::to_array<std::uint32_t>({
    20, 21, 23,          // PARAM_REQUEST_READ, _LIST, PARAM_SET
    110,                 // FILE_TRANSFER_PROTOCOL
    117, 119, 120, 121,  // LOG_REQUEST_LIST, LOG_REQUEST_DATA, LOG_DATA, LOG_ERASE
    134,                 // TERRAIN_DATA
    233,                 // GPS_RTCM_DATA
    320, 321, 323,       // PARAM_EXT_REQUEST_READ, _LIST, PARAM_EXT_SET
});
auto constexpr perishable_ids = std::to_array<std::uint32_t>({
    0,           // HEARTBEAT
    69, 70,      // MANUAL_CONTROL, RC_CHANNELS_OVERRIDE
    82, 84, 86,  // SET_ATTITUDE_TARGET, SET_POSITION_TARGET_LOCAL_NED, _GLOBAL_INT
    111,         // TIMESYNC: an answer that waited measures the queue
    232, 233,    // GPS_INPUT, GPS_RTCM_DATA
});
auto constexpr state_ids = std::to_array<std::uint32_t>({
    0,   1,     2,  // HEARTBEAT, SYS_STATUS, SYSTEM_TIME
    24,  25,    26,    27,    28,    29,
    30,  31,    32,                       // GPS_RAW_INT .. LOCAL_POSITION_NED
    33,  34,    35,    36,    42,    49,  // GLOBAL_POSITION_INT .. SERVO_OUTPUT_RAW, MISSION_CURRENT, GPS_GLOBAL_ORIGIN
    62,  65,    74,    83,    85,    87,  // NAV_CONTROLLER_OUTPUT, RC_CHANNELS, VFR_HUD, targets
    105, 116,   124,   125,   127,   128,
    129, 132,   136,  // HIGHRES_IMU, SCALED_IMU2, GPS2_RAW, POWER_STATUS, RTK .. TERRAIN
    137, 141,   147,   150,   152,   162,
    163, 164,   165,  // pressures, ALTITUDE, BATTERY_STATUS, MEMINFO, FENCE, AHRS, HWSTATUS
    168, 173,   178,   182,   193,   226,
    230, 231,   241,  // WIND, RANGEFINDER, AHRS2, AHRS3, EKF, RPM, ESTIMATOR, VIBRATION
    242, 245,   269,   285,   290,   291,
    330, 331,   340,                         // HOME_POSITION, EXTENDED_SYS_STATE, gimbal, ESC, OBSTACLE, ODOMETRY
    436, 11020, 11030, 11031, 11032, 11039,  // CURRENT_MODE, AOA_SSA, ESC_TELEMETRY, WATER_DEPTH
});
auto constexpr event_ids = std::to_array<std::uint32_t>({
    46,       // MISSION_ITEM_REACHED
    112,      // CAMERA_TRIGGER
    180,      // CAMERA_FEEDBACK
    253,      // STATUSTEXT
    263,      // CAMERA_IMAGE_CAPTURED
    410, 412  // EVENT, RESPONSE_EVENT_ERROR
});
// SYSTEM_TIME, GPS_RAW_INT, RAW_IMU, ATTITUDE, quaternion, LOCAL_POSITION_NED, GLOBAL_POSITION_INT, SERVO_OUTPUT_RAW
auto constexpr clock_ids = std::to_array<std::uint32_t>({2, 24, 27, 30, 31, 32, 33, 36});
static_assert(std::ranges::is_sorted(bulk_ids) && std::ranges::is_sorted(perishable_ids));
static_assert(std::ranges::is_sorted(state_ids) && std::ranges::is_sorted(event_ids));

/// Arming excepted: that must not overtake what was said before it.
bool may_stop(Frame const& frame) {
  std::uint32_t constexpr set_mode = 11;
  std::uint32_t constexpr command_int = 75;
  std::uint32_t constexpr command_long = 76;
  if (frame.message_id == set_mode) return true;
  if (frame.message_id != command_int && frame.message_id != command_long) return false;
  // In both the command stands behind 28 bytes, of which the first four are its first parameter.
  auto const at = [&frame](std::size_t place) { return std::uint32_t{frame.payload[place]}; };
  auto const param1 = at(0) | at(1) << 8U | at(2) << 16U | at(3) << 24U;
  switch (static_cast<MavCmd>(at(28) | at(29) << 8U)) {
    case MavCmd::nav_return_to_launch:
    case MavCmd::nav_land:
    case MavCmd::do_set_mode:
    case MavCmd::do_flight_termination: return true;
    case MavCmd::component_arm_disarm: return std::bit_cast<float>(param1) == 0.0F;
    default: return false;
  }
}

}  // namespace

Traffic traffic_of(std::uint32_t message_id) {
  return std::ranges::binary_search(bulk_ids, message_id) ? Traffic::bulk : Traffic::command;
}

link::Urgency urgency_of(Frame const& frame) {
  if (std::ranges::binary_search(perishable_ids, frame.message_id)) return link::Urgency::perishable;
  return may_stop(frame) ? link::Urgency::urgent : link::Urgency::prompt;
}

bool is_setpoint(std::uint32_t message_id) {
  return message_id == 82 || message_id == 84 || message_id == 86 || message_id == 139;
}

bool tells_state(std::uint32_t message_id) {
  return std::ranges::binary_search(state_ids, message_id);
}

bool tells_event(std::uint32_t message_id) {
  return std::ranges::binary_search(event_ids, message_id);
}

bool carries_clock(std::uint32_t message_id) {
  return std::ranges::binary_search(clock_ids, message_id);
}

}  // namespace lapwing::mavlink::internal
