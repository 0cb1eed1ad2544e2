#include "firmware/wire/frame.hpp"

#include "firmware/wire/crc16.hpp"

namespace lapwing::firmware {

FrameBytes write_frame(Packet const& packet) {
  std::array<std::uint8_t, longest_packet> plain{};
  plain[0] = protocol_version;
  plain[1] = packet.type;
  plain[2] = packet.sequence;
  std::size_t size = 3;
  for (auto const byte : packet.payload) plain[size++] = byte;
  auto const crc = crc16(std::span(plain).first(size));
  plain[size++] = static_cast<std::uint8_t>(crc & 0xFFU);
  plain[size++] = static_cast<std::uint8_t>(crc >> 8U);

  FrameBytes frame;
  frame.size = write_cobs(std::span(plain).first(size), frame.bytes);
  frame.bytes[frame.size++] = 0;
  return frame;
}

bool FrameReader::push(std::uint8_t byte) {
  if (byte == 0) return finish();
  // The last place is the delimiter's.
  if (size_ + 1 == buffer_.size())
    is_too_long_ = true;
  else
    buffer_[size_++] = byte;
  return false;
}

bool FrameReader::finish() {
  auto const size = size_;
  auto const is_too_long = is_too_long_;
  size_ = 0;
  is_too_long_ = false;
  // Zeros between frames are allowed: a sender may begin with one to end what noise began.
  if (size == 0) return false;
  auto const plain_size = is_too_long ? std::nullopt : read_cobs(std::span(buffer_).first(size));
  if (!plain_size || *plain_size < packet_overhead) {
    ++counters_.damaged;
    return false;
  }
  auto const plain = std::span<std::uint8_t const>(buffer_).first(*plain_size);
  auto const body = plain.first(plain.size() - 2);
  if (crc16(body) != (plain[body.size()] | plain[body.size() + 1] << 8)) {
    ++counters_.damaged;
    return false;
  }
  if (body[0] != protocol_version) {
    ++counters_.other_version;
    other_version_ = body[0];
    return false;
  }
  packet_ = {.type = body[1], .sequence = body[2], .payload = body.subspan(3)};
  ++counters_.frames;
  if (has_sequence_) counters_.missed += static_cast<std::uint8_t>(packet_.sequence - next_sequence_);
  has_sequence_ = true;
  next_sequence_ = static_cast<std::uint8_t>(packet_.sequence + 1);
  return true;
}

}  // namespace lapwing::firmware
