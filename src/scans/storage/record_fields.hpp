#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace lapwing::scans {

/// The fields of a record of MCAP, one after the other and little-endian. Once one is not there, none is.
class RecordFields {
 public:
  explicit RecordFields(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral T>
  [[nodiscard]] T number() {
    auto const bytes = take(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i > 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i - 1]);
    return static_cast<T>(value);
  }
  /// With four bytes of its length before it.
  [[nodiscard]] std::string_view text() { return take(number<std::uint32_t>()); }
  [[nodiscard]] std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) is_good_ = false;
    if (!is_good_) return {};
    auto const taken = rest_.substr(0, static_cast<std::size_t>(size));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  [[nodiscard]] std::string_view rest() const { return is_good_ ? rest_ : std::string_view(); }
  [[nodiscard]] bool is_good() const { return is_good_; }

 private:
  std::string_view rest_;
  bool is_good_ = true;
};

}  // namespace lapwing::scans
