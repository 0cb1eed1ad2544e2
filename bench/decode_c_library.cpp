#include "decode_c_library.hpp"

#include <ardupilotmega/mavlink.h>

namespace lapwing::bench {

namespace {

double decode(mavlink_message_t const& message) {
  switch (message.msgid) {
    case MAVLINK_MSG_ID_HEARTBEAT: {
      mavlink_heartbeat_t m;
      mavlink_msg_heartbeat_decode(&message, &m);
      return m.custom_mode;
    }
    case MAVLINK_MSG_ID_GLOBAL_POSITION_INT: {
      mavlink_global_position_int_t m;
      mavlink_msg_global_position_int_decode(&message, &m);
      return m.lat * 1e-7;
    }
    case MAVLINK_MSG_ID_ATTITUDE: {
      mavlink_attitude_t m;
      mavlink_msg_attitude_decode(&message, &m);
      return static_cast<double>(m.yaw);
    }
    case MAVLINK_MSG_ID_SYS_STATUS: {
      mavlink_sys_status_t m;
      mavlink_msg_sys_status_decode(&message, &m);
      return m.voltage_battery * 1e-3;
    }
    case MAVLINK_MSG_ID_VFR_HUD: {
      mavlink_vfr_hud_t m;
      mavlink_msg_vfr_hud_decode(&message, &m);
      return static_cast<double>(m.groundspeed);
    }
    case MAVLINK_MSG_ID_GPS_RAW_INT: {
      mavlink_gps_raw_int_t m;
      mavlink_msg_gps_raw_int_decode(&message, &m);
      return m.lat * 1e-7;
    }
    default: return 0.0;
  }
}

}  // namespace

ParsedByC parse_with_c_library(std::span<std::uint8_t const> bytes, bool decode_fields) {
  ParsedByC result;
  mavlink_message_t message;
  mavlink_status_t status;
  for (auto const byte : bytes) {
    if (mavlink_parse_char(MAVLINK_COMM_0, byte, &message, &status) == 0) continue;
    ++result.frames;
    if (decode_fields) result.checksum += decode(message);
  }
  return result;
}

}  // namespace lapwing::bench
