#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "mavlink/wire/frame.hpp"
#include "mavlink/wire/raw_message.hpp"

/// Packets for the tests of this room.
namespace lapwing::route {

using Bytes = std::vector<std::uint8_t>;
using mavlink::Address;

struct Packet {
  Bytes bytes;
  /// Valid as long as the packet.
  [[nodiscard]] mavlink::FrameView view() const {
    mavlink::FrameView found;
    mavlink::FrameParser parser;
    parser.feed_views(bytes, [&](mavlink::FrameView const& view) { found = view; });
    return found;
  }
};

struct PacketOptions {
  Address source{1, 1};
  Address target{};
  std::uint8_t seq = 0;
  std::uint8_t version = 2;
  std::vector<mavlink::RawField> fields = {};
};

inline Packet packet(std::string_view name, PacketOptions const& options = {}) {
  auto frame = mavlink::raw_message(name, options.fields, options.source, options.target).value();
  frame.seq = options.seq;
  frame.version = options.version;
  auto const out = mavlink::serialize(frame);
  return {{out.bytes().begin(), out.bytes().end()}};
}

/// A MAVLink 2 frame of a message that no dialect has.
inline Packet unknown_packet(std::uint32_t id, Address source = {1, 1}) {
  mavlink::Frame frame;
  frame.source = source;
  frame.message_id = id;
  frame.payload_size = 4;
  frame.payload[3] = 7;
  auto const whole = mavlink::serialize_as_received(frame);
  auto const bytes = whole.bytes();
  Bytes out(bytes.begin(), bytes.end() - 2);
  std::uint8_t const seed = 99;  // only its sender knows it
  auto const sum = mavlink::crc_accumulate({&seed, 1}, mavlink::crc_accumulate(std::span(out).subspan(1)));
  out.push_back(static_cast<std::uint8_t>(sum & 0xFFU));
  out.push_back(static_cast<std::uint8_t>(sum >> 8U));
  return {out};
}

}  // namespace lapwing::route
