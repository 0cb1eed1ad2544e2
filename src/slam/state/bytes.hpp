#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// Numbers as bytes, the lowest first, whatever the machine.
class ByteWriter {
 public:
  template <std::unsigned_integral T>
  void number(T value) {
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<char>(value >> (8 * i)));
  }
  void real(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void real(float value) { number(std::bit_cast<std::uint32_t>(value)); }
  void pose(Pose2 const& pose) {
    for (auto const value : {pose.x, pose.y, pose.yaw}) real(value);
  }
  void flag(bool value) { number(static_cast<std::uint8_t>(value ? 1 : 0)); }
  /// Of less than 4 GB: its length, then itself.
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
  }
  [[nodiscard]] std::string take() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// The same backwards. What is read past the end is zero and empty, and `is_short` says so.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral T>
  [[nodiscard]] T number() {
    auto const bytes = take(sizeof(T));
    T value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value = static_cast<T>(value | (static_cast<T>(static_cast<unsigned char>(bytes[i])) << (8 * i)));
    return value;
  }
  [[nodiscard]] double real() { return std::bit_cast<double>(number<std::uint64_t>()); }
  [[nodiscard]] float single() { return std::bit_cast<float>(number<std::uint32_t>()); }
  [[nodiscard]] Pose2 pose() {
    auto const x = real();
    auto const y = real();
    return {x, y, real()};
  }
  [[nodiscard]] std::string_view text() { return take(number<std::uint32_t>()); }
  [[nodiscard]] std::string_view take(std::size_t size) {
    if (rest_.size() < size) {
      is_short_ = true;
      rest_ = {};
      return {};
    }
    auto const taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  /// Whether so many things of at least that many bytes can still follow.
  [[nodiscard]] bool has(std::uint64_t count, std::size_t each) const { return count <= rest_.size() / each; }
  [[nodiscard]] std::size_t rest() const { return rest_.size(); }
  [[nodiscard]] bool is_short() const { return is_short_; }

 private:
  std::string_view rest_;
  bool is_short_ = false;
};

}  // namespace lapwing::slam
