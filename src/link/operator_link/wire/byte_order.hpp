#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "link/byte_link.hpp"

namespace lapwing::link::operator_link {

/// Integers and texts as bytes, the lowest byte first.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& to) : to_(to) {}

  template <std::unsigned_integral T>
  void number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) to_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
  void bytes(std::string_view text) { to_.insert(to_.end(), text.begin(), text.end()); }
  /// A length, and then so many bytes. Precondition: the length fits.
  template <std::unsigned_integral Length>
  void text(std::string_view text) {
    number(static_cast<Length>(text.size()));
    bytes(text);
  }

 private:
  std::vector<std::uint8_t>& to_;
};

/// The same backwards. What is read past the end is zero and empty, and `is_whole` says so.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : rest_(bytes) {}

  template <std::unsigned_integral T>
  [[nodiscard]] T number() {
    T value = 0;
    if (!has(sizeof(T))) return value;
    for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value | (static_cast<T>(rest_[i]) << (8 * i)));
    rest_ = rest_.subspan(sizeof(T));
    return value;
  }
  template <std::unsigned_integral Length>
  [[nodiscard]] std::string text() {
    return bytes(number<Length>());
  }
  [[nodiscard]] std::string rest() { return bytes(rest_.size()); }
  /// Nothing was missing, and nothing is left.
  [[nodiscard]] bool is_whole() const { return !is_short_ && rest_.empty(); }

 private:
  [[nodiscard]] bool has(std::size_t size) {
    if (rest_.size() >= size) return true;
    is_short_ = true;
    rest_ = {};
    return false;
  }
  [[nodiscard]] std::string bytes(std::size_t size) {
    if (!has(size)) return {};
    std::string text(rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size));
    rest_ = rest_.subspan(size);
    return text;
  }

  Bytes rest_;
  bool is_short_ = false;
};

/// CRC-32 as in zlib, Ethernet and PNG, of what comes after what `before` is the CRC of.
[[nodiscard]] std::uint32_t crc32(Bytes bytes, std::uint32_t before = 0);

}  // namespace lapwing::link::operator_link
