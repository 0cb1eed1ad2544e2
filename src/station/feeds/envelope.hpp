#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "station/feeds/feed.hpp"

namespace lapwing::station {

/// What a viewer is told of a message of a feed beside its content.
struct Envelope {
  std::string_view feed;       ///< by which texts name it
  std::uint16_t feed_id = 0;   ///< by which bytes do, and `hello` tells both
  std::uint64_t revision = 0;  ///< what the viewer has once it has taken the message
  bool begins_whole = false;   ///< forget what you had
};

/// The size of what stands before the bytes of a binary message.
inline constexpr std::size_t binary_header_size = 16;

/// The content as it goes out: a text gets the keys `feed`, `revision` and, where it is so, `whole`; bytes get a header
/// ("Binary messages" in docs/reference/station-messages.md). A text must be a JSON object that has a key.
[[nodiscard]] std::string in_envelope(Frame frame, Envelope const& envelope);

}  // namespace lapwing::station
