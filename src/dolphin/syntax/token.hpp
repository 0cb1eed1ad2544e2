#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "base/text/source.hpp"

namespace lapwing::dolphin {

enum class TokenKind : std::uint8_t {
  end_of_file,
  identifier,
  integer,
  decimal,
  string,               ///< a whole string without interpolation, quotes included
  string_open,          ///< the opening quotes of a string with interpolation
  string_text,          ///< text between interpolations
  interpolation_name,   ///< $name.member.member
  interpolation_open,   ///< ${
  interpolation_close,  ///< its }
  string_close,         ///< the closing quotes
  pattern,              ///< a regular expression, slashes included
  invalid,              ///< what no script has; a mistake that has been reported
  // brackets and separators
  left_paren,
  right_paren,
  left_bracket,
  right_bracket,
  left_brace,
  right_brace,
  comma,
  semicolon,
  colon,
  dot,
  safe_dot,
  spread_dot,
  range,
  range_exclusive,
  arrow,
  question,
  elvis,
  // operators
  assign,
  plus_assign,
  minus_assign,
  times_assign,
  divide_assign,
  remainder_assign,
  power_assign,
  shift_left_assign,
  shift_right_assign,
  bit_and_assign,
  bit_xor_assign,
  bit_or_assign,
  plus,
  minus,
  star,
  slash,
  percent,
  power,
  plus_plus,
  minus_minus,
  shift_left,
  shift_right,
  less,
  less_equal,
  greater,
  greater_equal,
  equal,
  not_equal,
  compare,
  find_match,
  full_match,
  logical_not,
  logical_and,
  logical_or,
  bit_and,
  bit_or,
  bit_xor,
  tilde,
  // reserved words
  kw_as,
  kw_assert,
  kw_break,
  kw_case,
  kw_catch,
  kw_class,
  kw_continue,
  kw_def,
  kw_default,
  kw_do,
  kw_else,
  kw_enum,
  kw_false,
  kw_finally,
  kw_for,
  kw_if,
  kw_import,
  kw_in,
  kw_instanceof,
  kw_interface,
  kw_new,
  kw_null,
  kw_package,
  kw_return,
  kw_switch,
  kw_throw,
  kw_true,
  kw_try,
  kw_while,
};

[[nodiscard]] constexpr bool is_reserved_word(TokenKind kind) {
  return kind >= TokenKind::kw_as;
}

/// Blanks, comments and line ends between tokens are not tokens: they are the gaps between spans.
struct Token {
  static constexpr std::uint32_t unclosed = std::numeric_limits<std::uint32_t>::max();

  TokenKind kind = TokenKind::end_of_file;
  bool newline_before = false;  ///< a line ends between this token and the one before
  bool blank_before = false;    ///< anything at all stands between this token and the one before
  base::Span span;
  std::uint32_t partner = unclosed;  ///< of a bracket: the index of the one that matches it
};

}  // namespace lapwing::dolphin
