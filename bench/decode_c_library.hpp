#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace lapwing::bench {

/// Parses `bytes` with the MAVLink C library, byte by byte as its interface demands, and decodes the fields of the
/// messages that our decoder also decodes. Returns how many frames it accepted; `checksum` keeps the optimiser honest.
struct ParsedByC {
  std::size_t frames = 0;
  double checksum = 0.0;
};
[[nodiscard]] ParsedByC parse_with_c_library(std::span<std::uint8_t const> bytes, bool decode_fields);

}  // namespace lapwing::bench
