#include "dolphin/syntax/code_points.hpp"

#include <algorithm>
#include <clocale>
#include <cwctype>

#include "base/assert.hpp"
#include "dolphin/syntax/characters.hpp"

namespace lapwing::dolphin {

namespace {

using Change = wint_t (*)(wint_t, locale_t);

/// Case by the C library's Unicode tables, whatever the user's language is set to.
std::string changed(std::string_view text, Change change) {
  static locale_t const unicode = newlocale(LC_CTYPE_MASK, "C.UTF-8", nullptr);
  std::string out;
  out.reserve(text.size());
  for (auto const piece : code_points(text)) {
    auto const c = decode_utf8(piece);
    bool const is_known = c.size > 0 && (unicode || c.value < 0x80);
    if (!is_known) {
      out += piece;
      continue;
    }
    auto const locale = unicode ? unicode : LC_GLOBAL_LOCALE;
    append_utf8(out, static_cast<char32_t>(change(static_cast<wint_t>(c.value), locale)));
  }
  return out;
}

}  // namespace

std::size_t count_code_points(std::string_view text) {
  bool const is_ascii = std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  return is_ascii ? text.size() : code_points(text).size();
}

std::size_t first_code_point_size(std::string_view text) {
  LAPWING_ASSERT(!text.empty());
  return std::max<std::size_t>(decode_utf8(text).size, 1);
}

std::vector<std::string_view> code_points(std::string_view text) {
  std::vector<std::string_view> pieces;
  pieces.reserve(text.size());
  while (!text.empty()) {
    auto const size = first_code_point_size(text);
    pieces.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return pieces;
}

std::string in_capitals(std::string_view text) {
  return changed(text, [](wint_t c, locale_t locale) { return towupper_l(c, locale); });
}

std::string in_small_letters(std::string_view text) {
  return changed(text, [](wint_t c, locale_t locale) { return towlower_l(c, locale); });
}

}  // namespace lapwing::dolphin
