#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/wire/cobs.hpp"

namespace lapwing::firmware {

/// Of the records and what they mean. Both ends of a line must speak the same one: frames of another are counted, and
/// not read.
std::uint8_t constexpr protocol_version = 1;

std::size_t constexpr longest_payload = 240;
/// Version, type, sequence; the CRC after the payload.
std::size_t constexpr packet_overhead = 3 + 2;
std::size_t constexpr longest_packet = longest_payload + packet_overhead;
/// With the zero that ends it. A longer run of bytes without a zero is noise.
std::size_t constexpr longest_frame = longest_cobs(longest_packet) + 1;

/// What a frame carries. The payload is borrowed from who has it.
struct Packet {
  std::uint8_t type = 0;
  std::uint8_t sequence = 0;  ///< counts the frames of one direction, modulo 256
  std::span<std::uint8_t const> payload;
};

/// A frame as it goes onto the line.
struct FrameBytes {
  std::array<std::uint8_t, longest_frame> bytes{};
  std::size_t size = 0;
  [[nodiscard]] std::span<std::uint8_t const> view() const { return std::span(bytes).first(size); }
};

/// COBS(version, type, sequence, payload, CRC low, CRC high), then zero. Precondition: the payload has at most
/// `longest_payload` bytes.
[[nodiscard]] FrameBytes write_frame(Packet const& packet);

/// Finds the frames in a stream that may begin anywhere and have lost or changed any byte of it.
///
/// `push` each byte; after one for which it says true, `packet` stands until the next `push`.
class FrameReader {
 public:
  struct Counters {
    std::uint32_t frames = 0;
    std::uint32_t damaged = 0;        ///< runs of bytes that were no frame: too long, no COBS, another CRC
    std::uint32_t other_version = 0;  ///< whole frames of another protocol version
    std::uint32_t missed = 0;         ///< by the gaps in the sequence; at most 255 are seen at once
  };

  [[nodiscard]] bool push(std::uint8_t byte);
  [[nodiscard]] Packet const& packet() const { return packet_; }
  [[nodiscard]] Counters const& counters() const { return counters_; }
  /// The version of the last frame that was of another one.
  [[nodiscard]] std::uint8_t other_version() const { return other_version_; }

 private:
  bool finish();

  std::array<std::uint8_t, longest_frame> buffer_{};
  std::size_t size_ = 0;
  bool is_too_long_ = false;
  bool has_sequence_ = false;
  std::uint8_t next_sequence_ = 0;
  std::uint8_t other_version_ = 0;
  Packet packet_;
  Counters counters_;
};

}  // namespace lapwing::firmware
