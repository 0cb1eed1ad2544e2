#include <bit>
#include <cstring>

#include "mavlink/wire/frame.hpp"

namespace lapwing::mavlink {

namespace {

/// tables[n][b]: what byte b, followed by n zero bytes, does to the CRC. With all eight, eight bytes go in at once
/// ("slicing by 8", Kounavis and Berry 2005).
using CrcTables = std::array<std::array<std::uint16_t, 256>, 8>;

consteval CrcTables make_tables() {
  CrcTables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1U) != 0 ? (crc >> 1U) ^ 0x8408U : crc >> 1U;
    tables[0][byte] = static_cast<std::uint16_t>(crc);
  }
  for (std::size_t n = 1; n < tables.size(); ++n)
    for (std::size_t byte = 0; byte < 256; ++byte) {
      auto const shorter = tables[n - 1][byte];
      tables[n][byte] = static_cast<std::uint16_t>((shorter >> 8U) ^ tables[0][shorter & 0xFFU]);
    }
  return tables;
}

constexpr CrcTables tables = make_tables();

}  // namespace

std::uint16_t crc_accumulate(std::span<std::uint8_t const> bytes, std::uint16_t crc) {
  auto const* p = bytes.data();
  auto left = bytes.size();
  for (; left >= 8; left -= 8, p += 8) {
    auto const first = static_cast<std::uint8_t>(p[0] ^ (crc & 0xFFU));
    auto const second = static_cast<std::uint8_t>(p[1] ^ (crc >> 8U));
    crc = static_cast<std::uint16_t>(tables[7][first] ^ tables[6][second] ^ tables[5][p[2]] ^ tables[4][p[3]] ^
                                     tables[3][p[4]] ^ tables[2][p[5]] ^ tables[1][p[6]] ^ tables[0][p[7]]);
  }
  for (; left > 0; --left, ++p) crc = static_cast<std::uint16_t>((crc >> 8U) ^ tables[0][(crc ^ *p) & 0xFFU]);
  return crc;
}

}  // namespace lapwing::mavlink
