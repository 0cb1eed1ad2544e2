#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace lapwing::firmware {

// Consistent Overhead Byte Stuffing (Cheshire and Baker, IEEE/ACM Transactions on Networking 7(2), 1999): bytes written
// without a zero, so that a zero ends a packet and a reader that joins in the middle finds its place at the next one.

/// A code byte for each 254 bytes that have no zero, and one for the rest.
[[nodiscard]] constexpr std::size_t longest_cobs(std::size_t bytes) {
  return bytes + bytes / 254 + 1;
}

/// How many bytes of `out` were written, none of them zero. Precondition: `out` has room for `longest_cobs`.
[[nodiscard]] std::size_t write_cobs(std::span<std::uint8_t const> bytes, std::span<std::uint8_t> out);

/// Decodes in place; how many bytes there were. None where a zero stands inside, or a code points beyond the end.
[[nodiscard]] std::optional<std::size_t> read_cobs(std::span<std::uint8_t> bytes);

}  // namespace lapwing::firmware
