#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <string_view>

/// Numbers in what is kept packed, little endian.
namespace lapwing::map::past {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& to, T value) {
  auto const bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  to.append(bytes.data(), bytes.size());
}

/// Nothing when there is not so much left.
template <class T>
std::optional<T> take(std::string_view& from) {
  if (from.size() < sizeof(T)) return std::nullopt;
  std::array<char, sizeof(T)> bytes;
  std::ranges::copy(from.substr(0, sizeof(T)), bytes.begin());
  from.remove_prefix(sizeof(T));
  return std::bit_cast<T>(bytes);
}

}  // namespace lapwing::map::past
