#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace lapwing::vision::internal {

using Bytes = std::span<std::byte const>;

inline std::uint32_t byte_at(Bytes bytes, std::size_t at) {
  return at < bytes.size() ? std::to_integer<std::uint32_t>(bytes[at]) : 0;
}

/// Numbers of `length` bytes; what lies beyond the end counts as 0.
inline std::uint32_t big_endian(Bytes bytes, std::size_t at, std::size_t length) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < length; ++k) value = (value << 8U) | byte_at(bytes, at + k);
  return value;
}

inline std::uint32_t little_endian(Bytes bytes, std::size_t at, std::size_t length) {
  std::uint32_t value = 0;
  for (std::size_t k = length; k-- > 0;) value = (value << 8U) | byte_at(bytes, at + k);
  return value;
}

inline bool says(Bytes bytes, std::size_t at, std::string_view text) {
  if (bytes.size() < at || bytes.size() - at < text.size()) return false;
  return std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

}  // namespace lapwing::vision::internal
