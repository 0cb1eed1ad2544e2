#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/time.hpp"

namespace lapwing::link::operator_link {

/// How a message is to be treated when the far end cannot be reached at once. Each kind has a lane of its own, so that
/// a command never waits behind a day of log lines.
enum class Kind : std::uint8_t {
  durable,  ///< must not be lost: kept, on disk where there is one, until the far end has taken it; in order
  command,  ///< worth something now: a newer one of its key takes its place, and it ends at its expiry
  latest,   ///< only the newest of its key counts: heartbeats, poses
};
inline constexpr std::size_t kinds = 3;
[[nodiscard]] std::string_view to_string(Kind kind);

struct Message {
  Kind kind = Kind::durable;
  std::string text;
  std::string key = {};          ///< what it overtakes: empty overtakes nothing; at most 255 bytes
  base::Duration lifetime = {};  ///< of commands and latest ones: worth nothing afterwards; zero: no end
};

/// One that came.
struct Received {
  Kind kind = Kind::durable;
  std::string key;
  std::string text;
  std::uint64_t stream = 0;  ///< with `number` the name of this message: the same when it comes again after a crash
  std::uint64_t number = 0;
};

/// The sender's name for what it said.
struct MessageId {
  Kind kind = Kind::durable;
  std::uint64_t number = 0;
  friend constexpr auto operator<=>(MessageId const&, MessageId const&) = default;
};

/// What became of a message.
enum class Outcome : std::uint8_t {
  taken,      ///< the program at the far end has it
  overtaken,  ///< a newer one of its key took its place
  expired,
  unknown,  ///< a command was with a program that ended before it answered: nobody knows whether it was carried out
};
[[nodiscard]] std::string_view to_string(Outcome outcome);

/// A text of a message or of one JSON object, each way.
inline constexpr std::size_t longest_text = 1024 * 1024;
inline constexpr std::size_t longest_key = 255;
inline constexpr std::size_t longest_name = 64;
inline constexpr std::size_t longest_token = 256;

}  // namespace lapwing::link::operator_link
