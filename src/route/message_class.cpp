#include "route/message_class.hpp"

#include "mavlink/wire/message_kinds.hpp"

namespace lapwing::route {

using mavlink::Kind;

namespace {

std::uint32_t constexpr gps_rtcm_data = 233;

base::Duration constexpr order_life = std::chrono::seconds(2);
base::Duration constexpr correction_life = std::chrono::seconds(5);

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
  if (!frame.traits || is(id, Kind::bulk)) return MessageClass::bulk;
  if (is(id, Kind::single)) return MessageClass::command;
  bool const has_target = frame.traits->target_system_at != mavlink::no_field;
  if (!has_target || is(id, Kind::replaced)) return MessageClass::telemetry;
  return MessageClass::command;
}

bool is_order(mavlink::FrameView const& frame) {
  return is(frame.message_id, Kind::order) || is(frame.message_id, Kind::answer);
}

std::optional<base::Duration> shelf_life(mavlink::FrameView const& frame) {
  if (is(frame.message_id, Kind::order)) return order_life;
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
