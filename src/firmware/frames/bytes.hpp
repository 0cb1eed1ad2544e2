#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace lapwing::firmware {

// Numbers as they stand in a payload: integers, the low byte first. Quantities are integers of a stated fraction of
// their unit, so that a controller without floating point can speak this, too, and no value is infinite or none.

class ByteWriter {
 public:
  explicit ByteWriter(std::span<std::uint8_t> into) : into_(into) {}

  template <std::integral T>
  void number(T value) {
    auto rest = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      if (size_ < into_.size()) into_[size_++] = static_cast<std::uint8_t>(rest & 0xFFU);
      if constexpr (sizeof(T) > 1) rest = static_cast<std::make_unsigned_t<T>>(rest >> 8U);
    }
  }
  /// `value * per_unit`, rounded; what does not fit is the nearest that does, what is no number is zero.
  template <std::integral T>
  void quantity(float value, double per_unit) {
    double const scaled = static_cast<double>(value) * per_unit;
    double constexpr least = std::numeric_limits<T>::min();
    double constexpr most = std::numeric_limits<T>::max();
    if (scaled >= most)
      number(std::numeric_limits<T>::max());
    else if (scaled <= least)
      number(std::numeric_limits<T>::min());
    else
      number(scaled == scaled ? static_cast<T>(std::lround(scaled)) : T{0});
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  std::span<std::uint8_t> into_;
  std::size_t size_ = 0;
};

/// Reading beyond the end gives zeros and is told by `is_whole`.
class ByteReader {
 public:
  explicit ByteReader(std::span<std::uint8_t const> from) : from_(from) {}

  template <std::integral T>
  [[nodiscard]] T number() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i, ++at_)
      if (at_ < from_.size()) value |= static_cast<std::uint64_t>(from_[at_]) << 8U * i;
    return static_cast<T>(value);
  }
  template <std::integral T>
  [[nodiscard]] float quantity(double per_unit) {
    return static_cast<float>(static_cast<double>(number<T>()) / per_unit);
  }
  /// All was read, and there was not less.
  [[nodiscard]] bool is_whole() const { return at_ == from_.size(); }

 private:
  std::span<std::uint8_t const> from_;
  std::size_t at_ = 0;
};

}  // namespace lapwing::firmware
