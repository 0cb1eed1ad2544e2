#include "dolphin/syntax/characters.hpp"

#include <algorithm>
#include <array>

namespace lapwing::dolphin {

namespace {

struct CodeRange {
  char32_t first;
  char32_t last;
};

/// Beyond ASCII everything is a letter but these: punctuation, symbols, blanks, private use, emoji, non-characters.
constexpr auto not_letters = std::to_array<CodeRange>({
    {0x0080, 0x00A9},
    {0x00AB, 0x00B4},
    {0x00B6, 0x00B9},
    {0x00BB, 0x00BF},
    {0x00D7, 0x00D7},
    {0x00F7, 0x00F7},
    {0x2000, 0x2BFF},
    {0x3000, 0x303F},
    {0xD800, 0xF8FF},
    {0xFE00, 0xFE1F},
    {0xFEFF, 0xFEFF},
    {0xFF00, 0xFF0F},
    {0xFFF0, 0xFFFF},
    {0x1F000, 0x1FAFF},
});

constexpr auto blanks = std::to_array<CodeRange>({
    {0x00A0, 0x00A0},
    {0x2000, 0x200B},
    {0x202F, 0x202F},
    {0x205F, 0x205F},
    {0x3000, 0x3000},
    {0xFEFF, 0xFEFF},
});

bool within(auto const& ranges, char32_t c) {
  return std::ranges::any_of(ranges, [c](CodeRange range) { return range.first <= c && c <= range.last; });
}

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}
bool is_ascii_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_hex_digit(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

std::size_t count_while(std::string_view text, std::size_t from, auto&& accepts) {
  auto at = from;
  while (at < text.size() && (accepts(text[at]) || (text[at] == '_' && at > from))) ++at;
  return at;
}

std::size_t scan_fraction_and_exponent(std::string_view text, std::size_t at) {
  if (at + 1 < text.size() && text[at] == '.' && is_digit(text[at + 1])) at = count_while(text, at + 1, is_digit);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    auto digits = at + 1;
    if (digits < text.size() && (text[digits] == '+' || text[digits] == '-')) ++digits;
    if (digits < text.size() && is_digit(text[digits])) at = count_while(text, digits, is_digit);
  }
  return at;
}

}  // namespace

CodePoint decode_utf8(std::string_view text) {
  if (text.empty()) return {};
  auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  std::size_t const size = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < size) return {};
  char32_t value = byte(0) & (0x7Fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0u) != 0x80u) return {};
    value = (value << 6u) | (byte(i) & 0x3Fu);
  }
  constexpr std::array<char32_t, 5> smallest = {0, 0, 0x80, 0x800, 0x10000};
  bool const valid = value >= smallest[size] && value <= 0x10FFFF && (value < 0xD800 || value > 0xDFFF);
  return valid ? CodePoint{value, size} : CodePoint{};
}

void append_utf8(std::string& out, char32_t c) {
  auto const put = [&](char32_t byte) { out += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0u | (c >> 6u));
  } else if (c < 0x10000) {
    put(0xE0u | (c >> 12u));
    put(0x80u | ((c >> 6u) & 0x3Fu));
  } else {
    put(0xF0u | (c >> 18u));
    put(0x80u | ((c >> 12u) & 0x3Fu));
    put(0x80u | ((c >> 6u) & 0x3Fu));
  }
  put(0x80u | (c & 0x3Fu));
}

std::string as_utf8(std::string_view bytes) {
  std::string out;
  while (!bytes.empty()) {
    auto const size = decode_utf8(bytes).size;
    if (size > 0) out += bytes.substr(0, size);
    if (size == 0) append_utf8(out, U'\uFFFD');
    bytes.remove_prefix(std::max<std::size_t>(size, 1));
  }
  return out;
}

std::size_t identifier_start(std::string_view text) {
  if (text.empty()) return 0;
  if (is_ascii(text[0])) return is_ascii_letter(text[0]) ? 1 : 0;
  auto const c = decode_utf8(text);
  return c.size > 0 && !within(not_letters, c.value) ? c.size : 0;
}

std::size_t identifier_character(std::string_view text) {
  if (!text.empty() && is_digit(text[0])) return 1;
  return identifier_start(text);
}

std::size_t blank_size(std::string_view text) {
  if (text.empty()) return 0;
  if (is_ascii(text[0])) return text[0] == ' ' || text[0] == '\t' || text[0] == '\f' || text[0] == '\v' ? 1 : 0;
  auto const c = decode_utf8(text);
  return within(blanks, c.value) ? c.size : 0;
}

Unreadable unreadable_character(std::string_view text) {
  auto const c = decode_utf8(text);
  switch (c.value) {
    case U'\u2018':
    case U'\u2019': return {c.size, "a typographic quote cannot enclose a string", "write '", Unreadable::Like::quote};
    case U'\u201C':
    case U'\u201D':
    case U'\u201E': return {c.size, "a typographic quote cannot enclose a string", "write \"", Unreadable::Like::quote};
    case U'\u2010':
    case U'\u2012':
    case U'\u2013':
    case U'\u2014':
    case U'\u2212': return {c.size, "a typographic dash is not a minus sign", "write -", Unreadable::Like::dash};
    case U'#': return {1, "# begins no comment", "write //", Unreadable::Like::comment};
    case U'$': return {1, "a name needs no $ outside a text", "", Unreadable::Like::blank};
    default: break;
  }
  if (c.size == 0) return {1, "these bytes are not UTF-8 text", "save the script as UTF-8"};
  if (c.value < 0x20 || c.value == 0x7F) return {c.size, "control characters cannot stand in a script", ""};
  return {c.size, "this character cannot stand here", ""};
}

ScannedNumber scan_number(std::string_view text) {
  ScannedNumber out;
  auto const second = text.size() > 1 ? text[1] : '\0';
  auto const third = text.size() > 2 ? text[2] : '\0';
  auto at = std::size_t{0};
  auto suffixes = std::string_view("lLiIgG");
  if (text[0] == '0' && (second == 'x' || second == 'X') && is_hex_digit(third)) {
    at = count_while(text, 2, is_hex_digit);
  } else if (text[0] == '0' && (second == 'b' || second == 'B') && (third == '0' || third == '1')) {
    at = count_while(text, 2, [](char c) { return c == '0' || c == '1'; });
  } else {
    auto const whole = count_while(text, 0, is_digit);
    at = scan_fraction_and_exponent(text, whole);
    out.is_decimal = at > whole;
    suffixes = "lLiIgGdDfF";
  }
  if (at < text.size() && suffixes.contains(text[at]) && identifier_character(text.substr(at + 1)) == 0) {
    out.is_decimal = out.is_decimal || std::string_view("dDfF").contains(text[at]);
    ++at;
  }
  out.size = at;
  while (auto const size = identifier_character(text.substr(out.size))) out.size += size;
  out.junk = out.size - at;
  return out;
}

}  // namespace lapwing::dolphin
