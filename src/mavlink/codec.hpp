#pragma once

#include <optional>

#include "mavlink/frame.hpp"
#include "mavlink/messages.hpp"

namespace lapwing::mavlink {

/// The frame's message in SI units; nothing when it is of a kind that this program does not use.
[[nodiscard]] std::optional<Message> decode(Frame const& frame);

/// The message as a MAVLink 2 frame, values rounded to what the wire can hold; for MAVLink 1 set `version` afterwards.
[[nodiscard]] Frame encode(Message const& message, Address self, std::uint8_t seq);

}  // namespace lapwing::mavlink
