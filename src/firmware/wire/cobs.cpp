#include "firmware/wire/cobs.hpp"

namespace lapwing::firmware {

namespace {

std::uint8_t constexpr longest_run = 0xFF;  ///< this code says: 254 bytes follow, and no zero after them

}  // namespace

std::size_t write_cobs(std::span<std::uint8_t const> bytes, std::span<std::uint8_t> out) {
  std::size_t code_at = 0;
  std::size_t end = 1;
  std::uint8_t code = 1;
  auto const close_run = [&] {
    out[code_at] = code;
    code_at = end++;
    code = 1;
  };
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i] == 0) {
      close_run();
      continue;
    }
    out[end++] = bytes[i];
    // A full run at the very end needs no other code behind it.
    if (++code == longest_run && i + 1 < bytes.size()) close_run();
  }
  out[code_at] = code;
  return end;
}

std::optional<std::size_t> read_cobs(std::span<std::uint8_t> bytes) {
  std::size_t from = 0;
  std::size_t to = 0;
  while (from < bytes.size()) {
    std::uint8_t const code = bytes[from++];
    if (code == 0 || bytes.size() - from < code - 1U) return std::nullopt;
    for (unsigned i = 1; i < code; ++i) {
      if (bytes[from] == 0) return std::nullopt;
      bytes[to++] = bytes[from++];
    }
    if (code != longest_run && from < bytes.size()) bytes[to++] = 0;
  }
  return to;
}

}  // namespace lapwing::firmware
