#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "base/time.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::mavlink {

// Packet signing, https://mavlink.io/en/guide/message_signing.html: who does not know the key can neither command a
// vehicle nor speak for one, nor play back what he heard. Nothing is encrypted. signing_guard.hpp decides whom to hear.

using SigningKey = std::array<std::uint8_t, 32>;

/// SHA-256 of the words, as MAVProxy and Mission Planner make keys of pass phrases.
[[nodiscard]] SigningKey key_from_passphrase(std::string_view words);

/// Time as signatures count it: units of 10 us since 2015-01-01 UTC, 48 bits.
using SigningTime = std::uint64_t;
[[nodiscard]] SigningTime signing_time(base::UtcTime time);
[[nodiscard]] SigningTime signing_span(base::Duration duration);

/// Signs `frame` (MAVLink 2, about to be sent) as the sender of this link at this time.
void sign(Frame& frame, SigningKey const& key, std::uint8_t link_id, SigningTime time);
/// Whether the signature was made with `key`, of exactly this frame.
[[nodiscard]] bool is_signed_with(Frame const& frame, SigningKey const& key);
/// Of a signed frame.
[[nodiscard]] SigningTime time_of_signature(Frame const& frame);

/// Whether such a message tells a key to whoever reads it (SETUP_SIGNING): it is not recorded, and routers show it to
/// nobody but its addressee.
[[nodiscard]] bool tells_a_key(std::uint32_t message_id);
[[nodiscard]] inline bool tells_a_key(Frame const& frame) {
  return tells_a_key(frame.message_id);
}

}  // namespace lapwing::mavlink
