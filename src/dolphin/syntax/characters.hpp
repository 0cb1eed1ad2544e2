#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

/// What the characters of a script are. All functions look at the beginning of `text`; sizes are in bytes, 0 for "is
/// none".
namespace lapwing::dolphin {

[[nodiscard]] constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

struct CodePoint {
  char32_t value = 0;
  std::size_t size = 0;  ///< 0: not UTF-8
};
[[nodiscard]] CodePoint decode_utf8(std::string_view text);
void append_utf8(std::string& out, char32_t code_point);
/// The text with U+FFFD in the place of every byte that is not UTF-8.
[[nodiscard]] std::string as_utf8(std::string_view bytes);

/// Letters of any script, and `_`.
[[nodiscard]] std::size_t identifier_start(std::string_view text);
/// Those and digits.
[[nodiscard]] std::size_t identifier_character(std::string_view text);
/// Space, tab, form feed, and the blanks that word processors leave behind.
[[nodiscard]] std::size_t blank_size(std::string_view text);

/// Why a character cannot stand in a script.
struct Unreadable {
  std::size_t size;
  std::string_view message;
  std::string_view hint;
  enum class Like { nothing, quote, dash, comment, blank } looks_like = Like::nothing;
};
[[nodiscard]] Unreadable unreadable_character(std::string_view text);

struct ScannedNumber {
  std::size_t size = 0;  ///< suffix and junk included
  std::size_t junk = 0;  ///< bytes at the end that cannot belong to a number: 10km
  bool is_decimal = false;
};
/// `text` begins with a digit.
[[nodiscard]] ScannedNumber scan_number(std::string_view text);

}  // namespace lapwing::dolphin
