#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "base/text/source.hpp"
#include "dolphin/services/format/statement_places.hpp"
#include "dolphin/syntax/lexer.hpp"
#include "dolphin/syntax/token.hpp"

/// A script as the formatter sees it: tokens and comments in one row.
namespace lapwing::dolphin {

/// What a sign is to the words beside it.
enum class Role : std::uint8_t {
  plain,
  prefix,   ///< `-` of -1, `!`, `++` of ++x
  postfix,  ///< `++` of x++
  label,    ///< `:` of name: value and case 1:
  loop,     ///< `:` of for (x : list)
  operand,  ///< ends a value: what follows is an operator, an index, a call
  comment,
};

/// A token, a whole string with its interpolations, or a comment.
struct Piece {
  TokenKind kind = TokenKind::end_of_file;  ///< string for all strings, identifier for words behind a point
  Role role = Role::plain;
  base::Span span;
  std::size_t line_ends = 0;  ///< between this piece and the one before
  bool is_continued = false;  ///< a backslash at the end of the line before
  bool has_blank_before = false;
  bool begins_statement = false;

  [[nodiscard]] bool is_comment() const { return role == Role::comment; }
};

/// All tokens up to and with end_of_file, and all comments, in order.
[[nodiscard]] std::vector<Piece> layout_pieces(TokenStream const& stream, StatementPlaces const& places,
                                               base::SourceFile const& source);

/// How many blanks stand between two pieces of one line.
[[nodiscard]] std::size_t blanks_between(Piece const& left, Piece const& right);

}  // namespace lapwing::dolphin
