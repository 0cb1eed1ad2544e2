#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "mavlink/frame.hpp"

namespace lapwing::route {

/// How a message is treated where a link takes less than there is to send.
enum class MessageClass {
  command,    ///< commands, missions, parameters, texts, events: first, in order, each one
  telemetry,  ///< values that the next one replaces, those for a vehicle (sticks, setpoints) included: the newest wins
  bulk,       ///< files, logs, pictures, and what the dialect lacks: in order, each one, beside telemetry
};
inline constexpr std::size_t message_classes = 3;
[[nodiscard]] std::string_view to_string(MessageClass message_class);

[[nodiscard]] MessageClass class_of(mavlink::FrameView const& frame);

/// What a telemetry message is a newer value of: one source's message, about one of its batteries, motors, names ...
struct StreamKey {
  std::uint64_t source_and_id = 0;
  std::uint64_t instance = 0;  ///< FNV-1a of the field that tells
  friend bool operator==(StreamKey const&, StreamKey const&) = default;
};
[[nodiscard]] StreamKey stream_of(mavlink::FrameView const& frame);

}  // namespace lapwing::route
