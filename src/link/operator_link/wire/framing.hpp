#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "link/byte_link.hpp"

namespace lapwing::link::operator_link {

/// What a frame is (docs/reference/operator-link.md has each byte of it).
enum class FrameType : std::uint8_t {
  hello = 1,     ///< a client's first word: who it is, what it holds and what it has heard
  welcome = 2,   ///< the server's answer, the same from its side
  refused = 3,   ///< the server's answer to who may not come in; the connection ends
  data = 4,      ///< one message
  ack = 5,       ///< all of a lane up to a number has been taken
  returned = 6,  ///< a message that was not taken, and why
  ping = 7,
  pong = 8,
  bye = 9,  ///< the far end closes on purpose
};

struct Frame {
  FrameType type;
  Bytes body;  ///< of the reader: valid until it is fed again
};

inline constexpr std::uint8_t framing_version = 1;
inline constexpr std::size_t frame_header_bytes = 12;
/// A message's text and what stands before it.
inline constexpr std::size_t longest_body = 1024 * 1024 + 512;
/// Of who has not said who he is.
inline constexpr std::size_t longest_first_body = 1024;

/// Appends a frame. Precondition: the body is no longer than `longest_body`.
void write_frame(std::vector<std::uint8_t>& to, FrameType type, Bytes body);

/// Frames out of a stream of bytes that may come in any pieces. A stream in which something is wrong is given up: over
/// TCP nothing that follows can be trusted, and a new connection goes on where this one ended.
///
/// Memory: what has come of the frames that were not taken yet, never what a length field promises.
class FrameReader {
 public:
  explicit FrameReader(std::size_t longest = longest_first_body) : longest_(longest) {}

  /// Longer frames are a fault.
  void allow(std::size_t longest) { longest_ = longest; }
  void feed(Bytes bytes);
  /// The next whole frame, or none yet. Error (invalid_input): what is wrong, and from then on always.
  [[nodiscard]] base::Result<std::optional<Frame>> next();

 private:
  std::size_t longest_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;
};

}  // namespace lapwing::link::operator_link
