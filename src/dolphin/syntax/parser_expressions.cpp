#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "dolphin/syntax/internal/literals.hpp"
#include "dolphin/syntax/internal/parser_class.hpp"

namespace lapwing::dolphin {

using base::Span;
using enum TokenKind;

// ---- primaries ----------------------------------------------------------------------------------

ast::ExprPtr Parser::primary() {
  switch (kind()) {
    case identifier: {
      if (auto const head = chain_head()) return chain(*head);
      if (at_otherwise()) return otherwise();
      auto const& word = advance();
      return make(ast::Name{std::string(text(word))}, word.span);
    }
    case integer:
    case decimal:
    case string:
    case kw_null:
    case kw_true:
    case kw_false: return literal();
    case string_open: return interpolated_string();
    case pattern: return pattern_literal();
    case invalid: {
      unread_.push_back(advance().span);
      quiet_ = true;  // the lexer has complained
      return broken();
    }
    case left_paren: return in_parentheses();
    case left_bracket: return list_or_map();
    case left_brace: return closure();
    case kw_new: return new_object();
    case dot:
      if (kind(1) == integer) {
        auto const begin = token().span.begin;
        expected("an expression", {fmt::format("write 0.{}", text(token(1))), {{{begin, begin}, "0"}}});
        return broken();
      }
      [[fallthrough]];
    default: expected("an expression"); return broken();
  }
}

ast::ExprPtr Parser::literal() {
  auto const& word = advance();
  switch (word.kind) {
    case kw_null: return make(ast::NullLiteral{}, word.span);
    case kw_true: return make(ast::BoolLiteral{true}, word.span);
    case kw_false: return make(ast::BoolLiteral{false}, word.span);
    case string: {
      auto const whole = text(word);
      bool const is_typographic = whole[0] != '\'' && whole[0] != '"';  // the lexer has complained
      if (is_typographic) return make(ast::StringLiteral{}, word.span);
      std::size_t const quotes = whole.size() >= 6 && whole[1] == whole[0] && whole[2] == whole[0] ? 3 : 1;
      auto const closed = whole.size() >= 2 * quotes && whole.back() == whole[0];
      auto const width = static_cast<std::uint32_t>(quotes);
      auto const end = closed ? word.span.end - width : word.span.end;
      return make(ast::StringLiteral{decode_string({word.span.begin + width, end}, diagnostics_)}, word.span);
    }
    default: return make(decode_number(word.span, word.kind == decimal, diagnostics_), word.span);
  }
}

/// Between slashes a backslash stands for itself, but before a slash.
ast::ExprPtr Parser::pattern_literal() {
  auto const& word = advance();
  ast::PatternLiteral made;
  auto const inside = text(word).substr(1, word.span.size() - 2);
  for (std::size_t at = 0; at < inside.size(); ++at) {
    if (inside.substr(at).starts_with("\\/")) ++at;
    made.text += inside[at];
    bool const interpolates = inside[at] == '$' && at + 1 < inside.size() &&
                              (inside[at + 1] == '{' || std::isalpha(static_cast<unsigned char>(inside[at + 1])));
    if (interpolates) {
      error(code("invalid-pattern"), word.span, "a pattern between slashes takes no $name",
            "write ~\"...${name}...\", with \\\\ for each backslash");
    }
  }
  return make(std::move(made), word.span);
}

ast::ExprPtr Parser::interpolated_string() {
  ast::GString made;
  auto const begin = advance().span.begin;
  while (!at(string_close) && !at(end_of_file)) {
    if (at(string_text)) {
      made.pieces.emplace_back(decode_string(advance().span, diagnostics_));
    } else if (at(interpolation_name)) {
      made.pieces.emplace_back(interpolated_name(advance()));
    } else {
      made.pieces.emplace_back(interpolated_expression());
    }
  }
  advance();
  return make(std::move(made), since(begin));
}

/// $name.member.member
ast::ExprPtr Parser::interpolated_name(Token const& token) {
  auto at = token.span.begin + 1;
  ast::ExprPtr made;
  while (at < token.span.end) {
    auto const rest = diagnostics_.source().text({at, token.span.end});
    auto const size = static_cast<std::uint32_t>(std::min(rest.find('.'), rest.size()));
    ast::Identifier word{std::string(rest.substr(0, size)), {at, at + size}};
    Span const span{token.span.begin + 1, at + size};
    made =
        made ? make(ast::Member{std::move(made), std::move(word)}, span) : make(ast::Name{std::move(word.text)}, span);
    at += size + 1;
  }
  return made;
}

ast::ExprPtr Parser::interpolated_expression() {
  auto const opener = next_;
  auto const open = advance().span;
  Lines const lines(newlines_matter_, false);
  if (at(interpolation_close)) {
    error(code("syntax"), cover(open, token().span), "this interpolation is empty", "write \\$ for a dollar sign");
    advance();
    return broken();
  }
  auto made = command();
  close(opener);
  return made;
}

ast::ExprPtr Parser::in_parentheses() {
  auto const opener = next_;
  advance();
  ast::ExprPtr made;
  {
    Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed && newlines_matter_);
    made = command();
    if (at(assign)) {
      error(code("syntax"), token().span, "an assignment cannot stand inside an expression", "== compares");
      unread_.push_back(made->span);
    }
    close(opener);
  }
  made->in_parentheses = true;
  return made;
}

/// A map is recognised by `name :`, `'text' :`, `1 :`, `(expr) :` or `[:]` at its beginning.
ast::ExprPtr Parser::list_or_map() {
  auto const opener = next_;
  auto const begin = advance().span.begin;
  Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed && newlines_matter_);
  if (at(colon) && kind(1) == right_bracket) {
    advance();
    advance();
    return make(ast::MapLiteral{}, since(begin));
  }
  bool const number_key = (at(integer) || at(decimal)) && kind(1) == colon;
  bool const computed_key =
      at(left_paren) && token().partner != Token::unclosed && tokens_[token().partner + 1].kind == colon;
  if (at_argument_name() || number_key || computed_key) return map_entries(opener, begin);
  ast::ListLiteral made;
  while (!at(right_bracket) && !at(end_of_file)) {
    made.items.push_back(expression());
    if (!accept(comma)) break;
  }
  close(opener);
  return make(std::move(made), since(begin));
}

ast::ExprPtr Parser::map_entries(std::size_t opener, std::uint32_t begin) {
  ast::MapLiteral made;
  while (!at(right_bracket) && !at(end_of_file)) {
    ast::MapEntry entry;
    bool const bare_word = (at(identifier) || is_reserved_word(kind())) && kind(1) == colon;
    if (bare_word) {
      auto const& word = advance();
      entry.key = make(ast::StringLiteral{std::string(text(word))}, word.span);
    } else {
      entry.key = primary();
    }
    if (!expect(colon, "':' and a value")) break;
    entry.value = expression();
    made.entries.push_back(std::move(entry));
    if (!accept(comma)) break;
  }
  close(opener);
  return make(std::move(made), since(begin));
}

ast::ExprPtr Parser::new_object() {
  auto const begin = advance().span.begin;
  ast::New made;
  if (!at(identifier)) {
    expected("the name of a type");
    return broken();
  }
  made.type = identifier_of(advance());
  while (at(dot) && kind(1) == identifier) {
    advance();
    made.type = identifier_of(advance());  // java.lang.RuntimeException is RuntimeException
  }
  if (at(left_paren) && on_same_line()) {
    made.arguments = arguments_in_parentheses();
  } else {
    expected("'(' and the arguments of the constructor");
  }
  return make(std::move(made), since(begin));
}

// ---- closures -----------------------------------------------------------------------------------

/// Looks ahead for the -> behind parameters, outside nested brackets and within one line but for breaks after commas
/// and before the -> itself.
bool Parser::has_arrow() const {
  for (auto at = next_; at < tokens_.size(); ++at) {
    auto const& token = tokens_[at];
    if (token.kind == arrow) return true;
    if (token.newline_before && at > next_ && tokens_[at - 1].kind != comma) return false;
    bool const opens = token.kind == left_paren || token.kind == left_bracket || token.kind == left_brace;
    if (opens && token.partner == Token::unclosed) return false;
    if (opens) {
      at = token.partner;
    } else if (token.kind == right_brace || token.kind == semicolon || token.kind == end_of_file) {
      return false;
    }
  }
  return false;
}

ast::ExprPtr Parser::closure() {
  auto const opener = next_;
  auto const begin = advance().span.begin;
  ast::Closure made;
  made.has_arrow = has_arrow();
  if (made.has_arrow) {
    made.parameters = parameters(arrow);
    expect(arrow, "'->'");
  }
  made.body = statements(right_brace);
  close(opener);
  made.body.span = since(begin);
  return make(std::move(made), since(begin));
}

}  // namespace lapwing::dolphin
