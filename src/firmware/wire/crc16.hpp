#pragma once

#include <cstdint>
#include <span>

namespace lapwing::firmware {

/// CRC-16/CCITT-FALSE ("IBM-3740"): polynomial 0x1021, starts at 0xFFFF, nothing reflected, nothing inverted. Of the
/// nine digits "123456789" it is 0x29B1. Bit by bit: a table would cost a small controller half a kilobyte.
[[nodiscard]] constexpr std::uint16_t crc16(std::span<std::uint8_t const> bytes) {
  std::uint32_t crc = 0xFFFF;
  for (std::uint32_t const byte : bytes) {
    crc ^= byte << 8U;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? (crc << 1U) ^ 0x1021U : crc << 1U;
    crc &= 0xFFFFU;
  }
  return static_cast<std::uint16_t>(crc);
}

}  // namespace lapwing::firmware
