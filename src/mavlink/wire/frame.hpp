#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mavlink/codec/enums.hpp"

namespace lapwing::mavlink {

/// One MAVLink packet as it travels (https://mavlink.io/en/guide/serialization.html). The payload is kept at its full
/// length: bytes that MAVLink 2 trimmed are zero again.
struct Frame {
  std::uint8_t version = 2;  ///< 1 or 2
  std::uint8_t incompat_flags = 0;
  std::uint8_t compat_flags = 0;
  std::uint8_t seq = 0;
  Address source{};
  std::uint32_t message_id = 0;
  std::uint16_t checksum = 0;
  std::uint8_t payload_size = 0;  ///< as it travelled
  std::array<std::uint8_t, 255> payload{};
  std::array<std::uint8_t, 13> signature{};  ///< counts when `is_signed()`

  [[nodiscard]] bool is_signed() const { return (incompat_flags & 0x01U) != 0; }
};

inline constexpr std::size_t max_frame_size = 280;

/// Of MessageTraits: the message has no such field.
inline constexpr std::uint8_t no_field = 255;

/// What the protocol's tables say about a message id.
struct MessageTraits {
  std::uint32_t id = 0;
  std::uint8_t crc_extra = 0;
  std::uint8_t min_size = 0;  ///< payload bytes without extension fields
  std::uint8_t max_size = 0;
  std::uint8_t target_system_at = no_field;  ///< where in the payload
  std::uint8_t target_component_at = no_field;
  std::uint8_t instance_at = no_field;  ///< of the field that tells apart which battery, motor, name ... it is about
  std::uint8_t instance_size = 0;
};
/// Null for an id that is not in the dialect.
[[nodiscard]] MessageTraits const* find_traits(std::uint32_t message_id);

/// A packet where it lies in a buffer, for those who pass it on as it is. Borrowed: lives as long as the buffer.
struct FrameView {
  std::span<std::uint8_t const> bytes = {};    ///< all of it, signature included
  std::span<std::uint8_t const> payload = {};  ///< as it travelled: zeros at the end may be missing
  std::uint32_t message_id = 0;
  std::uint16_t checksum = 0;
  std::uint8_t version = 2;
  std::uint8_t seq = 0;
  Address source{};
  MessageTraits const* traits = nullptr;  ///< null: the dialect lacks the message

  /// 0 for a byte that was trimmed, or that no field has.
  [[nodiscard]] std::uint8_t payload_byte(std::size_t at) const { return at < payload.size() ? payload[at] : 0; }
  /// Whom it is for; 0 stands for all, as it does where nobody can tell.
  [[nodiscard]] Address target() const {
    if (!traits) return {};
    return {payload_byte(traits->target_system_at), payload_byte(traits->target_component_at)};
  }
};

/// CRC-16/MCRF4XX ("X.25" in MAVLink's words) of `bytes`, going on from `crc`.
[[nodiscard]] std::uint16_t crc_accumulate(std::span<std::uint8_t const> bytes, std::uint16_t crc = 0xFFFF);

/// The packet's bytes; trimming is worked out anew, and so is the checksum where the id is known. Precondition: the id
/// is below 256 in version 1.
class FrameBytes {
 public:
  [[nodiscard]] std::span<std::uint8_t const> bytes() const { return {data_.data(), size_}; }

 private:
  friend FrameBytes serialize(Frame const& frame);
  friend FrameBytes serialize_as_received(Frame const& frame);
  void write(Frame const& frame, std::size_t payload_size);
  std::array<std::uint8_t, max_frame_size> data_;
  std::size_t size_ = 0;
};
[[nodiscard]] FrameBytes serialize(Frame const& frame);
/// The bytes in which a received packet came, whether or not its sender trimmed it.
[[nodiscard]] FrameBytes serialize_as_received(Frame const& frame);

struct ParserCounters {
  std::uint64_t frames = 0;
  std::uint64_t crc_errors = 0;
  std::uint64_t unknown_ids = 0;  ///< whole frames of a message that the dialect lacks
  std::uint64_t junk_bytes = 0;   ///< skipped while looking for a frame, boot texts for example
};

/// Finds frames in a stream of bytes, however it is cut. Skips what is no MAVLink and finds its way back after damage:
/// nothing that follows a bad frame is lost with it. Frames with incompatibility flags other than signing are skipped,
/// as the protocol demands; signatures are kept, not checked.
class FrameParser {
 public:
  /// Calls `take(Frame const&)` for each frame that `bytes` completes; the frame lives for the call. Also for unknown
  /// ids.
  template <class Take>
  void feed(std::span<std::uint8_t const> bytes, Take&& take) {
    feed_views(bytes, [&](FrameView const& view) {
      unpack(view);
      take(static_cast<Frame const&>(frame_));
    });
  }
  /// The same without unpacking: `take(FrameView const&)`.
  template <class Take>
  void feed_views(std::span<std::uint8_t const> bytes, Take&& take) {
    begin(bytes);
    while (next()) take(static_cast<FrameView const&>(view_));
    keep_rest();
  }
  [[nodiscard]] ParserCounters const& counters() const { return counters_; }

 private:
  enum class Step { frame, bad_checksum, skip, need_more };
  void begin(std::span<std::uint8_t const> bytes);
  bool next();
  void keep_rest();
  Step parse_at(std::span<std::uint8_t const> at, std::size_t& used);
  void unpack(FrameView const& view);
  void take_payload(std::span<std::uint8_t const> payload);

  FrameView view_;
  Frame frame_;
  std::span<std::uint8_t const> input_;  ///< what this call still has to look at
  std::size_t sealed_ = 0;               ///< bytes of `input_` that no frame may reach beyond
  std::vector<std::uint8_t> kept_;  ///< an unfinished frame from earlier calls, and while feeding what was joined to it
  ParserCounters counters_;
};

}  // namespace lapwing::mavlink
