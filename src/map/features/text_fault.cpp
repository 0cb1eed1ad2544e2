#include "map/features/text_fault.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include <fmt/format.h>

namespace lapwing::map {

namespace {

struct CodePoint {
  char32_t value = 0;
  std::size_t size = 0;  ///< 0: not UTF-8
};

/// RFC 3629: no longer form than needed, no surrogates, nothing above U+10FFFF. Precondition: not empty.
CodePoint first_of(std::string_view text) {
  auto const lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {lead, 1};
  auto const size = static_cast<std::size_t>(std::countl_one(lead));
  if (size < 2 || size > 4 || size > text.size()) return {};
  char32_t value = lead & (0xFFU >> (size + 1));
  for (auto const byte : text.substr(1, size - 1)) {
    if ((static_cast<unsigned char>(byte) & 0xC0U) != 0x80U) return {};
    value = (value << 6) | (static_cast<unsigned char>(byte) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
  bool const is_surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (value < least[size] || is_surrogate || value > 0x10FFFF) return {};
  return {value, size};
}

bool is_control(char32_t c) {
  bool const turns_direction = (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069);
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || turns_direction;
}

}  // namespace

std::optional<std::string> text_fault(std::string_view text, std::size_t most_bytes, Lines lines) {
  if (text.size() > most_bytes) return fmt::format("has {} bytes; at most {} are taken", text.size(), most_bytes);
  while (!text.empty()) {
    auto const [c, size] = first_of(text);
    if (size == 0) return "is no UTF-8";
    bool const breaks_line = lines == Lines::many && (c == U'\n' || c == U'\t');
    if (is_control(c) && !breaks_line)
      return fmt::format("has the control character U+{:04X}", static_cast<std::uint32_t>(c));
    text.remove_prefix(size);
  }
  return std::nullopt;
}

std::optional<std::string> id_fault(std::string_view id) {
  if (id.empty()) return "is empty";
  return text_fault(id, most_id_bytes);
}

std::optional<std::string> hash_fault(std::string_view hash) {
  constexpr std::size_t digits = 64;
  bool const is_hash = hash.size() == digits && hash.find_first_not_of("0123456789abcdef") == std::string_view::npos;
  return is_hash ? std::nullopt : std::optional<std::string>("is no hash (64 digits of SHA-256, in small letters)");
}

}  // namespace lapwing::map
