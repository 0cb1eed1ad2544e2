#include "route/message_class.hpp"

#include <algorithm>
#include <array>

namespace lapwing::route {

namespace {

/// Message ids of the common and ardupilotmega dialects, sorted.
auto constexpr bulk_ids = std::to_array<std::uint32_t>({
    110,  // FILE_TRANSFER_PROTOCOL
    118,  // LOG_ENTRY
    120,  // LOG_DATA
    126,  // SERIAL_CONTROL
    130,  // DATA_TRANSMISSION_HANDSHAKE
    131,  // ENCAPSULATED_DATA
    134,  // TERRAIN_DATA
    184,  // REMOTE_LOG_DATA_BLOCK
    185,  // REMOTE_LOG_BLOCK_STATUS
    233,  // GPS_RTCM_DATA: pieces, of which none replaces another
    266,  // LOGGING_DATA
    267,  // LOGGING_DATA_ACKED
    268,  // LOGGING_ACK
    385,  // TUNNEL
});
static_assert(std::ranges::is_sorted(bulk_ids));

/// For all, and yet not replaced by the next of their kind: answers, texts, events and pieces of something larger.
auto constexpr single_ids = std::to_array<std::uint32_t>({
    22,   // PARAM_VALUE
    46,   // MISSION_ITEM_REACHED
    77,   // COMMAND_ACK
    112,  // CAMERA_TRIGGER
    148,  // AUTOPILOT_VERSION
    180,  // CAMERA_FEEDBACK
    253,  // STATUSTEXT
    263,  // CAMERA_IMAGE_CAPTURED
    322,  // PARAM_EXT_VALUE
    324,  // PARAM_EXT_ACK
    410,  // EVENT
    411,  // CURRENT_EVENT_SEQUENCE
});
static_assert(std::ranges::is_sorted(single_ids));

std::uint32_t constexpr gps_rtcm_data = 233;

/// COMMAND_ACK and COMMAND_CANCEL, which are never too late.
auto constexpr answer_ids = std::to_array<std::uint32_t>({77, 80});
/// SET_MODE, COMMAND_INT, COMMAND_LONG.
auto constexpr order_ids = std::to_array<std::uint32_t>({11, 75, 76});

base::Duration constexpr order_life = std::chrono::seconds(2);
base::Duration constexpr correction_life = std::chrono::seconds(5);

/// For one vehicle, and yet values: an old position of a stick must not come after a new one has left.
auto constexpr setpoint_ids = std::to_array<std::uint32_t>({
    67,   // DATA_STREAM
    70,   // RC_CHANNELS_OVERRIDE
    82,   // SET_ATTITUDE_TARGET
    84,   // SET_POSITION_TARGET_LOCAL_NED
    86,   // SET_POSITION_TARGET_GLOBAL_INT
    139,  // SET_ACTUATOR_CONTROL_TARGET
    144,  // FOLLOW_TARGET
    282,  // GIMBAL_MANAGER_SET_ATTITUDE
    284,  // GIMBAL_DEVICE_SET_ATTITUDE
    285,  // GIMBAL_DEVICE_ATTITUDE_STATUS
    286,  // AUTOPILOT_STATE_FOR_GIMBAL_DEVICE
    287,  // GIMBAL_MANAGER_SET_PITCHYAW
    288,  // GIMBAL_MANAGER_SET_MANUAL_CONTROL
});
static_assert(std::ranges::is_sorted(setpoint_ids));

}  // namespace

std::string_view to_string(MessageClass message_class) {
  switch (message_class) {
    case MessageClass::command: return "command";
    case MessageClass::telemetry: return "telemetry";
    case MessageClass::bulk: return "bulk";
  }
  return "";
}

MessageClass class_of(mavlink::FrameView const& frame) {
  auto const id = frame.message_id;
  if (!frame.traits || std::ranges::binary_search(bulk_ids, id)) return MessageClass::bulk;
  if (std::ranges::binary_search(single_ids, id)) return MessageClass::command;
  bool const has_target = frame.traits->target_system_at != mavlink::no_field;
  if (!has_target || std::ranges::binary_search(setpoint_ids, id)) return MessageClass::telemetry;
  return MessageClass::command;
}

bool is_order(mavlink::FrameView const& frame) {
  return std::ranges::binary_search(order_ids, frame.message_id) ||
         std::ranges::binary_search(answer_ids, frame.message_id);
}

std::optional<base::Duration> shelf_life(mavlink::FrameView const& frame) {
  if (std::ranges::binary_search(order_ids, frame.message_id)) return order_life;
  if (frame.message_id == gps_rtcm_data) return correction_life;
  return std::nullopt;
}

StreamKey stream_of(mavlink::FrameView const& frame) {
  StreamKey key;
  key.source_and_id = static_cast<std::uint64_t>(frame.message_id) << 16U |
                      static_cast<std::uint64_t>(frame.source.system) << 8U | frame.source.component;
  if (!frame.traits || frame.traits->instance_at == mavlink::no_field) return key;
  std::uint64_t hash = 0xCBF29CE484222325U;
  for (std::size_t i = 0; i < frame.traits->instance_size; ++i)
    hash = (hash ^ frame.payload_byte(frame.traits->instance_at + i)) * 0x100000001B3U;
  key.instance = hash;
  return key;
}

}  // namespace lapwing::route
