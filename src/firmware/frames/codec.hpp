#pragma once

#include <cstdint>
#include <optional>

#include "firmware/frames/records.hpp"
#include "firmware/wire/frame.hpp"

namespace lapwing::firmware {

/// The number of each record on the line. From the board below 0x10, from the host from there on.
enum class FrameType : std::uint8_t {
  hello = 0x01,
  readings = 0x02,
  laser = 0x03,
  completed = 0x04,
  log = 0x05,
  hail = 0x10,
  drive = 0x11,
  turn = 0x12,
  stop = 0x13,
  kill = 0x14,
  release = 0x15,
  alive = 0x16,
};

/// A whole frame, to be sent as it is.
[[nodiscard]] FrameBytes write(FromBoard const& record, std::uint8_t sequence);
[[nodiscard]] FrameBytes write(FromHost const& record, std::uint8_t sequence);

/// What a packet says. None: its type is none of that side's, its length is not what the type has, or a value in it can
/// not be (an angle beyond two turns, more sonars than there may be, a piece beyond its scan).
[[nodiscard]] std::optional<FromBoard> read_from_board(Packet const& packet);
[[nodiscard]] std::optional<FromHost> read_from_host(Packet const& packet);

}  // namespace lapwing::firmware
