#include "dolphin/services/format/layout_pieces.hpp"

#include <algorithm>

namespace lapwing::dolphin {

namespace {

using enum TokenKind;

bool opens(TokenKind kind) {
  return kind == left_paren || kind == left_bracket || kind == left_brace;
}
bool closes(TokenKind kind) {
  return kind == right_paren || kind == right_bracket || kind == right_brace;
}
bool is_point(TokenKind kind) {
  return kind == dot || kind == safe_dot || kind == spread_dot || kind == range || kind == range_exclusive;
}

bool is_value(TokenKind kind) {
  return kind == identifier || kind == integer || kind == decimal || kind == string || kind == pattern ||
         closes(kind) || kind == kw_true || kind == kw_false || kind == kw_null;
}
bool ends_value(Piece const& piece) {
  return piece.role == Role::operand || piece.role == Role::postfix;
}

/// Finds out what each sign is. Looks at one token after the other and remembers the brackets round it.
class Roles {
 public:
  Role next(Piece const& before, Piece const& piece) {
    if (piece.begins_statement) brackets_.back().questions = 0;
    auto const role = role_of(before, piece);
    if (opens(piece.kind)) brackets_.push_back({0, piece.kind == left_paren && before.kind == kw_for});
    if (closes(piece.kind)) brackets_.pop_back();
    return role;
  }

 private:
  struct Bracket {
    std::size_t questions = 0;  ///< ternary operators that wait for their colon
    bool is_loop_head = false;
  };

  Role role_of(Piece const& before, Piece const& piece) {
    bool const follows_value = ends_value(before) && !piece.begins_statement;
    switch (piece.kind) {
      case logical_not:
      case tilde: return Role::prefix;
      case plus:
      case minus: return follows_value ? Role::plain : Role::prefix;
      case plus_plus:
      case minus_minus: return follows_value && piece.line_ends == 0 ? Role::postfix : Role::prefix;
      case question: ++brackets_.back().questions; return Role::plain;
      case colon: return role_of_colon();
      default: return is_value(piece.kind) ? Role::operand : Role::plain;
    }
  }

  Role role_of_colon() {
    auto& bracket = brackets_.back();
    if (bracket.questions == 0) return bracket.is_loop_head ? Role::loop : Role::label;
    --bracket.questions;
    return Role::plain;
  }

  std::vector<Bracket> brackets_{1};
};

/// Counts what stands between two pieces.
void read_gap(std::string_view gap, Piece& piece) {
  piece.has_blank_before = !gap.empty();
  for (std::size_t at = 0; at < gap.size(); ++at) {
    auto const c = gap[at];
    if (c == '\\') {
      piece.is_continued = true;
      at += gap.substr(at + 1).starts_with("\r\n") ? 2 : 1;
    } else if (c == '\n' || c == '\r') {
      ++piece.line_ends;
      if (gap.substr(at).starts_with("\r\n")) ++at;
    }
  }
  if (piece.line_ends > 0) piece.is_continued = false;
}

std::vector<Piece> tokens_and_comments(TokenStream const& stream) {
  std::vector<Piece> out;
  out.reserve(stream.tokens.size() + stream.comments.size());
  auto comment = stream.comments.begin();
  auto const comments_until = [&](std::uint32_t offset) {
    for (; comment != stream.comments.end() && comment->begin < offset; ++comment) {
      out.push_back({.role = Role::comment, .span = *comment});
    }
  };
  for (std::size_t i = 0; i < stream.tokens.size(); ++i) {
    auto const& token = stream.tokens[i];
    comments_until(token.span.begin);
    Piece piece{.kind = token.kind, .span = token.span};
    if (token.kind == string_open) {
      i = token.partner;
      piece.kind = string;
      piece.span.end = stream.tokens[i].span.end;
      while (comment != stream.comments.end() && comment->begin < piece.span.end) ++comment;
    }
    out.push_back(piece);
  }
  return out;
}

/// Whether two signs would be read as one without a blank.
bool would_merge(Piece const& left, Piece const& right) {
  bool const left_minus = left.kind == minus || left.kind == minus_minus;
  bool const right_minus = right.kind == minus || right.kind == minus_minus;
  bool const left_plus = left.kind == plus || left.kind == plus_plus;
  bool const right_plus = right.kind == plus || right.kind == plus_plus;
  return (left_minus && right_minus) || (left_plus && right_plus);
}

}  // namespace

std::vector<Piece> layout_pieces(TokenStream const& stream, StatementPlaces const& places,
                                 base::SourceFile const& source) {
  auto pieces = tokens_and_comments(stream);
  Roles roles;
  Piece const* before = nullptr;  // the token before, comments left out
  Piece const start{};
  std::uint32_t end = 0;
  for (auto& piece : pieces) {
    read_gap(source.text({end, piece.span.begin}), piece);
    end = piece.span.end;
    if (piece.is_comment()) continue;
    auto const& left = before ? *before : start;
    if (is_reserved_word(piece.kind) && (left.kind == dot || left.kind == safe_dot || left.kind == spread_dot))
      piece.kind = identifier;
    piece.begins_statement = places.contains(piece.span.begin);
    piece.role = roles.next(left, piece);
    before = &piece;
  }
  return pieces;
}

std::size_t blanks_between(Piece const& left, Piece const& right) {
  if (right.kind == comma || right.kind == semicolon || right.kind == right_paren || right.kind == right_bracket) {
    return 0;
  }
  if (left.kind == left_paren || left.kind == left_bracket) return 0;
  if (left.is_comment() || right.is_comment()) return 1;
  if (left.kind == left_brace && right.kind == right_brace) return 0;
  if (is_point(left.kind) || is_point(right.kind) || right.role == Role::postfix) return 0;
  if (left.role == Role::prefix) return would_merge(left, right) ? 1 : 0;
  if (right.role == Role::label) return 0;
  bool const may_call = right.kind == left_paren || right.kind == left_bracket;
  if (may_call && ends_value(left)) return right.has_blank_before ? 1 : 0;
  return 1;
}

}  // namespace lapwing::dolphin
