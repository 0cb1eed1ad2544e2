#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "dolphin/internal/literals.hpp"
#include "dolphin/internal/parser.hpp"

namespace lapwing::dolphin {

using base::Span;
using enum TokenKind;

namespace {

/// How tightly a binary operator binds; 1 is the weakest. (Language specification 2: Groovy's order.)
struct Operator {
  int strength;
  enum class Form { binary, range, range_exclusive, cast, instance_of } form = Form::binary;
  ast::BinaryOp op = ast::BinaryOp::add;
};

constexpr int weakest_operator = 1;

std::optional<Operator> binary_operator(TokenKind kind) {
  using ast::BinaryOp;
  using Form = Operator::Form;
  auto const plain = [](int strength, BinaryOp op) { return Operator{strength, Form::binary, op}; };
  switch (kind) {
    case logical_or: return plain(1, BinaryOp::logical_or);
    case logical_and: return plain(2, BinaryOp::logical_and);
    case bit_or: return plain(3, BinaryOp::bit_or);
    case bit_xor: return plain(4, BinaryOp::bit_xor);
    case bit_and: return plain(5, BinaryOp::bit_and);
    case equal: return plain(6, BinaryOp::equal);
    case not_equal: return plain(6, BinaryOp::not_equal);
    case compare: return plain(6, BinaryOp::compare);
    case less: return plain(7, BinaryOp::less);
    case less_equal: return plain(7, BinaryOp::less_equal);
    case greater: return plain(7, BinaryOp::greater);
    case greater_equal: return plain(7, BinaryOp::greater_equal);
    case kw_in: return plain(7, BinaryOp::in);
    case kw_as: return Operator{7, Form::cast};
    case kw_instanceof: return Operator{7, Form::instance_of};
    case shift_left: return plain(8, BinaryOp::shift_left);
    case shift_right: return plain(8, BinaryOp::shift_right);
    case range: return Operator{8, Form::range};
    case range_exclusive: return Operator{8, Form::range_exclusive};
    case plus: return plain(9, BinaryOp::add);
    case minus: return plain(9, BinaryOp::subtract);
    case star: return plain(10, BinaryOp::multiply);
    case slash: return plain(10, BinaryOp::divide);
    case percent: return plain(10, BinaryOp::remainder);
    default: return std::nullopt;
  }
}

std::optional<ast::UnaryOp> unary_operator(TokenKind kind) {
  switch (kind) {
    case logical_not: return ast::UnaryOp::logical_not;
    case minus: return ast::UnaryOp::minus;
    case plus: return ast::UnaryOp::plus;
    default: return std::nullopt;
  }
}

}  // namespace

// ---- operators ----------------------------------------------------------------------------------

ast::ExprPtr Parser::expression() {
  Nesting const nesting(*this);
  if (!nesting) {
    quiet_ = true;
    return broken();
  }
  return ternary();
}

ast::ExprPtr Parser::ternary() {
  auto const begin = token().span.begin;
  auto first = binary(weakest_operator);
  if (at(elvis) && operator_continues()) {
    auto const op = advance().span;
    auto other = expression();
    return make(ast::Binary{ast::BinaryOp::elvis, std::move(first), std::move(other), op}, since(begin));
  }
  if (!at(question) || !operator_continues()) return first;
  advance();
  auto if_true = expression();
  if (!expect(colon, "':' and the other value")) return if_true;
  auto if_false = expression();
  return make(ast::Ternary{std::move(first), std::move(if_true), std::move(if_false)}, since(begin));
}

/// Whether the operator that comes next belongs to this statement: it does when it cannot begin one (REC-7e).
bool Parser::operator_continues() const {
  if (!newlines_matter_ || !token().newline_before) return true;
  auto const which = kind();
  bool const could_begin =
      which == plus || which == minus || which == logical_not || which == plus_plus || which == minus_minus;
  return which >= dot && which <= bit_xor && !could_begin && which != assign && which != arrow;
}

ast::ExprPtr Parser::binary(int weakest) {
  using Form = Operator::Form;
  auto const begin = token().span.begin;
  auto left = unary();
  while (true) {
    auto const found = binary_operator(kind());
    if (!found || found->strength < weakest || !operator_continues()) return left;
    auto const op = advance().span;
    if (found->form == Form::cast || found->form == Form::instance_of) {
      if (!at(identifier)) {
        expected("the name of a type");
        return left;
      }
      auto type = identifier_of(advance());
      left = found->form == Form::cast ? make(ast::Cast{std::move(left), std::move(type)}, since(begin))
                                       : make(ast::InstanceOf{std::move(left), std::move(type)}, since(begin));
      continue;
    }
    auto right = binary(found->strength + 1);
    left = found->form == Form::binary
               ? make(ast::Binary{found->op, std::move(left), std::move(right), op}, since(begin))
               : make(ast::Range{std::move(left), std::move(right), found->form == Form::range}, since(begin));
  }
}

/// The digits of the least integer, which has no positive counterpart.
bool Parser::at_least_integer() const {
  return at(integer) && text(token()) == "9223372036854775808";
}

ast::ExprPtr Parser::unary() {
  auto const begin = token().span.begin;
  auto const sign = unary_operator(kind());
  if (!sign && !at(plus_plus) && !at(minus_minus)) return power();
  Nesting const nesting(*this);
  if (!nesting) {
    quiet_ = true;
    return broken();
  }
  auto const op = advance().kind;
  if (op == minus && at_least_integer()) {
    advance();
    return make(ast::IntegerLiteral{std::numeric_limits<std::int64_t>::min()}, since(begin));
  }
  auto operand = unary();
  if (sign) return make(ast::Unary{*sign, std::move(operand)}, since(begin));
  return make(ast::Step{std::move(operand), op == plus_plus ? 1 : -1, true}, since(begin));
}

ast::ExprPtr Parser::power() {
  auto const begin = token().span.begin;
  auto base = postfix();
  if (!at(TokenKind::power) || !operator_continues()) return base;
  Nesting const nesting(*this);
  if (!nesting) {
    quiet_ = true;
    return broken();
  }
  auto const op = advance().span;
  auto exponent = unary();
  return make(ast::Binary{ast::BinaryOp::power, std::move(base), std::move(exponent), op}, since(begin));
}

// ---- primaries ----------------------------------------------------------------------------------

ast::ExprPtr Parser::primary() {
  switch (kind()) {
    case identifier: {
      if (auto const head = chain_head()) return chain(*head);
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
      std::uint32_t const quotes = whole.size() >= 6 && whole[1] == whole[0] && whole[2] == whole[0] ? 3 : 1;
      auto const closed = whole.size() >= 2 * quotes && whole.back() == whole[0];
      auto const end = closed ? word.span.end - quotes : word.span.end;
      return make(ast::StringLiteral{decode_string({word.span.begin + quotes, end}, diagnostics_)}, word.span);
    }
    default: return make(decode_number(word.span, word.kind == decimal, diagnostics_), word.span);
  }
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
