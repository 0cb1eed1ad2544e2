#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "mavlink/codec/messages.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::mavlink {

/// A field of a vehicle's message that held what cannot be, "lat" of 214 degrees: it is absent from the message.
struct ImpossibleField {
  std::string_view name;  ///< as the dialect calls it
  double value;
  std::string_view unit;  ///< SI, "rad"; empty for a ratio
};

/// The frame's message in SI units; nothing when it is of a kind that this program does not use.
[[nodiscard]] std::optional<Message> decode(Frame const& frame);
/// The same; what was left out is appended to `impossible`.
[[nodiscard]] std::optional<Message> decode(Frame const& frame, std::vector<ImpossibleField>& impossible);

/// The message as a MAVLink 2 frame, values rounded to what the wire can hold; for MAVLink 1 set `version` afterwards.
[[nodiscard]] Frame encode(Message const& message, Address self, std::uint8_t seq);

}  // namespace lapwing::mavlink
