#include "mavlink/wire/message_kinds.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace lapwing::mavlink {

namespace {

/// Several kinds, as bits.
struct Kinds {
  std::uint16_t bits = 0;
  constexpr Kinds(Kind kind) : bits(std::to_underlying(kind)) {}  // NOLINT(google-explicit-constructor)
};
constexpr Kinds operator|(Kinds some, Kind another) {
  some.bits = static_cast<std::uint16_t>(some.bits | std::to_underlying(another));
  return some;
}
constexpr Kinds operator|(Kind one, Kind another) {
  return Kinds(one) | another;
}

constexpr MessageKinds row(std::uint32_t id, std::string_view name, Kinds kinds) {
  return {id, name, kinds.bits};
}

using enum Kind;

constexpr auto table = std::to_array<MessageKinds>({
    row(0, "HEARTBEAT", perishable | state),
    row(1, "SYS_STATUS", state),
    row(2, "SYSTEM_TIME", state | clock),
    row(11, "SET_MODE", order),
    row(20, "PARAM_REQUEST_READ", asks_for_bulk),
    row(21, "PARAM_REQUEST_LIST", asks_for_bulk),
    row(22, "PARAM_VALUE", single),
    row(23, "PARAM_SET", asks_for_bulk),
    row(24, "GPS_RAW_INT", state | clock),
    row(25, "GPS_STATUS", state),
    row(26, "SCALED_IMU", state),
    row(27, "RAW_IMU", state | clock),
    row(28, "RAW_PRESSURE", state),
    row(29, "SCALED_PRESSURE", state),
    row(30, "ATTITUDE", state | clock),
    row(31, "ATTITUDE_QUATERNION", state | clock),
    row(32, "LOCAL_POSITION_NED", state | clock),
    row(33, "GLOBAL_POSITION_INT", state | clock),
    row(34, "RC_CHANNELS_SCALED", state),
    row(35, "RC_CHANNELS_RAW", state),
    row(36, "SERVO_OUTPUT_RAW", state | clock),
    row(42, "MISSION_CURRENT", state),
    row(46, "MISSION_ITEM_REACHED", event | single),
    row(49, "GPS_GLOBAL_ORIGIN", state),
    row(62, "NAV_CONTROLLER_OUTPUT", state),
    row(65, "RC_CHANNELS", state),
    row(67, "DATA_STREAM", replaced),
    row(69, "MANUAL_CONTROL", perishable),
    row(70, "RC_CHANNELS_OVERRIDE", perishable | replaced),
    row(74, "VFR_HUD", state),
    row(75, "COMMAND_INT", order),
    row(76, "COMMAND_LONG", order),
    row(77, "COMMAND_ACK", single | answer),
    row(80, "COMMAND_CANCEL", answer),
    row(82, "SET_ATTITUDE_TARGET", perishable | setpoint | replaced),
    row(83, "ATTITUDE_TARGET", state),
    row(84, "SET_POSITION_TARGET_LOCAL_NED", perishable | setpoint | replaced),
    row(85, "POSITION_TARGET_LOCAL_NED", state),
    row(86, "SET_POSITION_TARGET_GLOBAL_INT", perishable | setpoint | replaced),
    row(87, "POSITION_TARGET_GLOBAL_INT", state),
    row(105, "HIGHRES_IMU", state),
    row(110, "FILE_TRANSFER_PROTOCOL", bulk),
    row(111, "TIMESYNC", perishable),
    row(112, "CAMERA_TRIGGER", event | single),
    row(116, "SCALED_IMU2", state),
    row(117, "LOG_REQUEST_LIST", asks_for_bulk),
    row(118, "LOG_ENTRY", bulk),
    row(119, "LOG_REQUEST_DATA", asks_for_bulk),
    row(120, "LOG_DATA", bulk),
    row(121, "LOG_ERASE", asks_for_bulk),
    row(124, "GPS2_RAW", state),
    row(125, "POWER_STATUS", state),
    row(126, "SERIAL_CONTROL", bulk),
    row(127, "GPS_RTK", state),
    row(128, "GPS2_RTK", state),
    row(129, "SCALED_IMU3", state),
    row(130, "DATA_TRANSMISSION_HANDSHAKE", bulk),
    row(131, "ENCAPSULATED_DATA", bulk),
    row(132, "DISTANCE_SENSOR", state),
    row(134, "TERRAIN_DATA", bulk),
    row(136, "TERRAIN_REPORT", state),
    row(137, "SCALED_PRESSURE2", state),
    row(139, "SET_ACTUATOR_CONTROL_TARGET", perishable | setpoint | replaced),
    row(141, "ALTITUDE", state),
    row(144, "FOLLOW_TARGET", replaced),
    row(147, "BATTERY_STATUS", state),
    row(148, "AUTOPILOT_VERSION", single),
    row(150, "SENSOR_OFFSETS", state),
    row(152, "MEMINFO", state),
    row(162, "FENCE_STATUS", state),
    row(163, "AHRS", state),
    row(164, "SIMSTATE", state),
    row(165, "HWSTATUS", state),
    row(168, "WIND", state),
    row(173, "RANGEFINDER", state),
    row(178, "AHRS2", state),
    row(180, "CAMERA_FEEDBACK", event | single),
    row(182, "AHRS3", state),
    row(184, "REMOTE_LOG_DATA_BLOCK", bulk),
    row(185, "REMOTE_LOG_BLOCK_STATUS", bulk),
    row(193, "EKF_STATUS_REPORT", state),
    row(226, "RPM", state),
    row(230, "ESTIMATOR_STATUS", state),
    row(231, "WIND_COV", state),
    row(232, "GPS_INPUT", perishable),
    row(233, "GPS_RTCM_DATA", bulk | perishable),
    row(241, "VIBRATION", state),
    row(242, "HOME_POSITION", state),
    row(245, "EXTENDED_SYS_STATE", state),
    row(253, "STATUSTEXT", event | single),
    row(263, "CAMERA_IMAGE_CAPTURED", event | single),
    row(266, "LOGGING_DATA", bulk),
    row(267, "LOGGING_DATA_ACKED", bulk),
    row(268, "LOGGING_ACK", bulk),
    row(269, "VIDEO_STREAM_INFORMATION", state),
    row(282, "GIMBAL_MANAGER_SET_ATTITUDE", replaced),
    row(284, "GIMBAL_DEVICE_SET_ATTITUDE", replaced),
    row(285, "GIMBAL_DEVICE_ATTITUDE_STATUS", replaced | state),
    row(286, "AUTOPILOT_STATE_FOR_GIMBAL_DEVICE", replaced),
    row(287, "GIMBAL_MANAGER_SET_PITCHYAW", replaced),
    row(288, "GIMBAL_MANAGER_SET_MANUAL_CONTROL", replaced),
    row(290, "ESC_INFO", state),
    row(291, "ESC_STATUS", state),
    row(320, "PARAM_EXT_REQUEST_READ", asks_for_bulk),
    row(321, "PARAM_EXT_REQUEST_LIST", asks_for_bulk),
    row(322, "PARAM_EXT_VALUE", single),
    row(323, "PARAM_EXT_SET", asks_for_bulk),
    row(324, "PARAM_EXT_ACK", single),
    row(330, "OBSTACLE_DISTANCE", state),
    row(331, "ODOMETRY", state),
    row(340, "UTM_GLOBAL_POSITION", state),
    row(385, "TUNNEL", bulk),
    row(410, "EVENT", event | single),
    row(411, "CURRENT_EVENT_SEQUENCE", single),
    row(412, "RESPONSE_EVENT_ERROR", event),
    row(436, "CURRENT_MODE", state),
    row(11020, "AOA_SSA", state),
    row(11030, "ESC_TELEMETRY_1_TO_4", state),
    row(11031, "ESC_TELEMETRY_5_TO_8", state),
    row(11032, "ESC_TELEMETRY_9_TO_12", state),
    row(11038, "WATER_DEPTH", state),
});
static_assert(std::ranges::is_sorted(table, {}, &MessageKinds::id));

/// Arming excepted: that must not overtake what was said before it.
bool may_stop(Frame const& frame) {
  std::uint32_t constexpr set_mode = 11;
  if (frame.message_id == set_mode) return true;
  if (!is(frame.message_id, Kind::order)) return false;
  // In COMMAND_INT and COMMAND_LONG the command stands behind 28 bytes, of which the first four are its first
  // parameter.
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

std::span<MessageKinds const> message_kinds() {
  return table;
}

bool is(std::uint32_t message_id, Kind kind) {
  auto const found = std::ranges::lower_bound(table, message_id, {}, &MessageKinds::id);
  return found != table.end() && found->id == message_id && (found->kinds & std::to_underlying(kind)) != 0;
}

Traffic traffic_of(std::uint32_t message_id) {
  return is(message_id, Kind::bulk) || is(message_id, Kind::asks_for_bulk) ? Traffic::bulk : Traffic::command;
}

link::Urgency urgency_of(Frame const& frame) {
  if (is(frame.message_id, Kind::perishable)) return link::Urgency::perishable;
  return may_stop(frame) ? link::Urgency::urgent : link::Urgency::prompt;
}

}  // namespace lapwing::mavlink
