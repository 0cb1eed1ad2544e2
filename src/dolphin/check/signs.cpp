#include "dolphin/check/signs.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace lapwing::dolphin {

namespace {

using enum TokenKind;

constexpr auto words = std::to_array<std::pair<std::string_view, TokenKind>>({
    {"as", kw_as},
    {"assert", kw_assert},
    {"break", kw_break},
    {"case", kw_case},
    {"catch", kw_catch},
    {"class", kw_class},
    {"continue", kw_continue},
    {"def", kw_def},
    {"default", kw_default},
    {"do", kw_do},
    {"else", kw_else},
    {"enum", kw_enum},
    {"false", kw_false},
    {"finally", kw_finally},
    {"for", kw_for},
    {"if", kw_if},
    {"import", kw_import},
    {"in", kw_in},
    {"instanceof", kw_instanceof},
    {"interface", kw_interface},
    {"new", kw_new},
    {"null", kw_null},
    {"package", kw_package},
    {"return", kw_return},
    {"switch", kw_switch},
    {"throw", kw_throw},
    {"true", kw_true},
    {"try", kw_try},
    {"while", kw_while},
});
static_assert(std::ranges::is_sorted(words, {}, &std::pair<std::string_view, TokenKind>::first));

/// Longest first where one begins another.
constexpr auto operators = std::to_array<std::pair<std::string_view, TokenKind>>({
    {"..<", range_exclusive},
    {"<=>", compare},
    {"==~", full_match},
    {"=~", find_match},
    {"**=", power_assign},
    {"<<=", shift_left_assign},
    {">>=", shift_right_assign},
    {"..", range},
    {"?.", safe_dot},
    {"*.", spread_dot},
    {"?:", elvis},
    {"->", arrow},
    {"+=", plus_assign},
    {"-=", minus_assign},
    {"*=", times_assign},
    {"/=", divide_assign},
    {"%=", remainder_assign},
    {"&=", bit_and_assign},
    {"^=", bit_xor_assign},
    {"|=", bit_or_assign},
    {"**", power},
    {"++", plus_plus},
    {"--", minus_minus},
    {"<<", shift_left},
    {">>", shift_right},
    {"<=", less_equal},
    {">=", greater_equal},
    {"==", equal},
    {"!=", not_equal},
    {"&&", logical_and},
    {"||", logical_or},
    {"(", left_paren},
    {")", right_paren},
    {"[", left_bracket},
    {"]", right_bracket},
    {"{", left_brace},
    {"}", right_brace},
    {",", comma},
    {";", semicolon},
    {":", colon},
    {".", dot},
    {"?", question},
    {"=", assign},
    {"+", plus},
    {"-", minus},
    {"*", star},
    {"/", slash},
    {"%", percent},
    {"<", less},
    {">", greater},
    {"!", logical_not},
    {"&", bit_and},
    {"|", bit_or},
    {"^", bit_xor},
    {"~", tilde},
});

constexpr auto foreign_signs = std::to_array<ForeignSign>({
    {"===", equal, "write =="},
    {"!==", not_equal, "write !="},
    {"<>", not_equal, "write !="},
    {":=", assign, "write ="},
    {"??", elvis, "write ?:"},
    {"=>", invalid, "write >= to compare; a closure is { x -> ... }"},
});

}  // namespace

TokenKind kind_of_word(std::string_view word) {
  auto const found = std::ranges::lower_bound(words, word, {}, &std::pair<std::string_view, TokenKind>::first);
  return found != words.end() && found->first == word ? found->second : identifier;
}

std::optional<Sign> sign_at(std::string_view text) {
  auto const found = std::ranges::find_if(operators, [&](auto const& entry) { return text.starts_with(entry.first); });
  return found == operators.end() ? std::nullopt : std::optional(Sign{found->second, found->first.size()});
}

ForeignSign const* foreign_sign_at(std::string_view text) {
  auto const found =
      std::ranges::find_if(foreign_signs, [&](ForeignSign const& one) { return text.starts_with(one.theirs); });
  return found == foreign_signs.end() ? nullptr : &*found;
}

bool asks_for_value(TokenKind kind) {
  switch (kind) {
    case left_paren:
    case left_bracket:
    case left_brace:
    case interpolation_open:
    case comma:
    case colon:
    case semicolon:
    case arrow:
    case question:
    case elvis:
    case equal:
    case not_equal:
    case find_match:
    case full_match:
    case logical_and:
    case logical_or:
    case plus:
    case tilde:
    case kw_case:
    case kw_in:
    case kw_return: return true;
    default: return kind >= assign && kind <= bit_or_assign;
  }
}

}  // namespace lapwing::dolphin
