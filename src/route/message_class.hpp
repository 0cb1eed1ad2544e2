#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/time.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::route {

/// How a message is treated where a link takes less than there is to send.
enum class MessageClass {
  command,    ///< commands, missions, parameters, texts, events: first, in order, each one
  telemetry,  ///< values that the next one replaces, those for a vehicle (sticks, setpoints) included: the newest wins
  bulk,       ///< files, logs, pictures, corrections, what the dialect lacks: in order, each one, beside telemetry
};
inline constexpr std::size_t message_classes = 3;
[[nodiscard]] std::string_view to_string(MessageClass message_class);

[[nodiscard]] MessageClass class_of(mavlink::FrameView const& frame);

/// Of the class `command` what goes first: orders to a vehicle and their answers (COMMAND_LONG, _INT, _ACK, _CANCEL,
/// SET_MODE), before parameters, missions and texts.
[[nodiscard]] bool is_order(mavlink::FrameView const& frame);

/// For how long a frame may wait and still be worth sending; nothing: for ever. An order that arrives when nobody
/// expects it any more is worse than none, and its sender repeats it. Corrections of the satellites grow old, too.
[[nodiscard]] std::optional<base::Duration> shelf_life(mavlink::FrameView const& frame);

/// What a telemetry message is a newer value of: one source's message, about one of its batteries, motors, names ...
struct StreamKey {
  std::uint64_t source_and_id = 0;
  std::uint64_t instance = 0;  ///< FNV-1a of the field that tells
  friend bool operator==(StreamKey const&, StreamKey const&) = default;
};
[[nodiscard]] StreamKey stream_of(mavlink::FrameView const& frame);

}  // namespace lapwing::route
