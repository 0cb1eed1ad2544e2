#pragma once

#include <bit>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

/// Numbers in what is kept packed, little endian.
namespace lapwing::map::past {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& to, T value) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, &value, sizeof(T));
  to.append(bytes, sizeof(T));
}

/// Nothing when there is not so much left.
template <class T>
std::optional<T> take(std::string_view& from) {
  if (from.size() < sizeof(T)) return std::nullopt;
  T value;
  std::memcpy(&value, from.data(), sizeof(T));
  from.remove_prefix(sizeof(T));
  return value;
}

}  // namespace lapwing::map::past
