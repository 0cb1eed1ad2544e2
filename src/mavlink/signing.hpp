#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string_view>

#include "base/time.hpp"
#include "mavlink/frame.hpp"

namespace lapwing::mavlink {

// Packet signing, https://mavlink.io/en/guide/message_signing.html: who does not know the key can neither command a
// vehicle nor speak for one, nor play back what he heard. Nothing is encrypted.

using SigningKey = std::array<std::uint8_t, 32>;

/// SHA-256 of the words, as MAVProxy and Mission Planner make keys of pass phrases.
[[nodiscard]] SigningKey key_from_passphrase(std::string_view words);

/// Time as signatures count it: units of 10 us since 2015-01-01 UTC, 48 bits.
using SigningTime = std::uint64_t;
[[nodiscard]] SigningTime signing_time(base::UtcTime time);

/// Signs `frame` (MAVLink 2, about to be sent) as the sender of this link at this time.
void sign(Frame& frame, SigningKey const& key, std::uint8_t link_id, SigningTime time);
/// Whether the signature was made with `key`, of exactly this frame.
[[nodiscard]] bool is_signed_with(Frame const& frame, SigningKey const& key);

/// What became of the frames that a guard saw.
struct SigningCounters {
  std::uint64_t accepted = 0;
  std::uint64_t unsigned_frames = 0;  ///< refused
  std::uint64_t wrong_key = 0;        ///< refused
  std::uint64_t replayed = 0;         ///< refused: heard before, or too old
};

/// One key for everything on a connection: signs what goes out, tells whom to listen to.
///
/// Refuses what carries no signature (but for RADIO_STATUS, which radios make and cannot sign), one of another key, or
/// one whose time has passed: each sender's clock only goes forward, and a sender not heard before is at most a minute
/// behind.
class SigningGuard {
 public:
  explicit SigningGuard(SigningKey const& key) : key_(key) {}

  /// Each signature's time is later than every one before, whatever the clock does.
  void sign(Frame& frame, std::uint8_t link_id, base::UtcTime now);
  [[nodiscard]] bool accepts(Frame const& frame, base::UtcTime now);
  [[nodiscard]] SigningCounters const& counters() const { return counters_; }

 private:
  struct Sender {
    Address source;
    std::uint8_t link_id = 0;
    friend auto operator<=>(Sender const&, Sender const&) = default;
  };
  SigningTime tick(base::UtcTime now) const;

  SigningKey key_;
  SigningTime last_ = 0;  ///< the latest that was sent or heard
  std::map<Sender, SigningTime> heard_;
  SigningCounters counters_;
};

}  // namespace lapwing::mavlink
