#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "dolphin/syntax/internal/parser_class.hpp"

/// Operators by precedence climbing, signs, casts.
namespace lapwing::dolphin {

using enum TokenKind;

namespace {

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
    case find_match: return plain(6, BinaryOp::find);
    case full_match: return plain(6, BinaryOp::match);
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
    case tilde: return ast::UnaryOp::complement;
    default: return std::nullopt;
  }
}

/// Types that may stand in parentheses in front of what is made one: `(int) x`.
constexpr auto cast_types = std::to_array<std::string_view>(
    {"BigDecimal", "BigInteger", "Boolean", "Collection", "Double", "Float", "Integer", "List",
     "Long",       "Map",        "Number",  "Object",     "Set",    "Short", "String",  "boolean",
     "byte",       "double",     "float",   "int",        "long",   "short"});

/// Words that join values in Python and Kotlin, and what is written here.
struct JoiningWord {
  std::string_view theirs;
  ast::BinaryOp op;
  std::string_view ours;
};
constexpr auto joining_words = std::to_array<JoiningWord>({
    {"and", ast::BinaryOp::logical_and, "&&"},
    {"or", ast::BinaryOp::logical_or, "||"},
    {"is", ast::BinaryOp::equal, "=="},
});

}  // namespace

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
    auto found = binary_operator(kind());
    if (!found && at_joining_word(0)) found = joining_word();
    if (!found || found->strength < weakest || !operator_continues()) return left;
    auto const op = advance().span;
    if (found->op == ast::BinaryOp::remainder && found->form == Form::binary && !starts_value(0)) {
      error(code("syntax"), op, "a value is missing behind %",
            fmt::format("write {}.percent", diagnostics_.source().text(left->span)));
      return left;
    }
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
  if (at_cast()) return cast();
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

/// From the left, as Groovy does: 2 ** 3 ** 2 is 64.
ast::ExprPtr Parser::power() {
  auto const begin = token().span.begin;
  auto base = postfix();
  while (at(TokenKind::power) && operator_continues()) {
    auto const op = advance().span;
    auto exponent = signed_postfix();
    base = make(ast::Binary{ast::BinaryOp::power, std::move(base), std::move(exponent), op}, since(begin));
  }
  return base;
}

/// What stands behind `**`, perhaps with signs.
ast::ExprPtr Parser::signed_postfix() {
  auto const begin = token().span.begin;
  auto const sign = unary_operator(kind());
  if (!sign) return postfix();
  Nesting const nesting(*this);
  if (!nesting) {
    quiet_ = true;
    return broken();
  }
  advance();
  auto operand = signed_postfix();
  return make(ast::Unary{*sign, std::move(operand)}, since(begin));
}

/// Whether an operand may begin at that token.
bool Parser::starts_value(std::size_t ahead) const {
  switch (kind(ahead)) {
    case identifier:
    case integer:
    case decimal:
    case string:
    case string_open:
    case pattern:
    case left_paren:
    case left_bracket:
    case left_brace:
    case minus:
    case plus:
    case plus_plus:
    case minus_minus:
    case logical_not:
    case tilde:
    case kw_true:
    case kw_false:
    case kw_null:
    case kw_new: return true;
    default: return false;
  }
}

/// `a and b`, where `and` is no variable: an operand follows it in its line.
bool Parser::at_joining_word(std::size_t ahead) const {
  if (kind(ahead) != identifier || !on_same_line(ahead) || !on_same_line(ahead + 1)) return false;
  bool const is_one = std::ranges::find(joining_words, text(token(ahead)), &JoiningWord::theirs) != joining_words.end();
  return is_one && starts_value(ahead + 1) && kind(ahead + 1) != left_brace;
}

/// Says how the operator is written here, and reads it as that.
std::optional<Operator> Parser::joining_word() {
  auto const& word = *std::ranges::find(joining_words, text(token()), &JoiningWord::theirs);
  bool const is_negative = word.op == ast::BinaryOp::equal && at_word("not", 1) && starts_value(2);
  error(code("foreign-operator"), token().span, fmt::format("there is no operator {}", word.theirs),
        fmt::format("write {}", is_negative ? "!=" : word.ours));
  if (is_negative) advance();
  auto const strength = word.op == ast::BinaryOp::logical_or ? 1 : word.op == ast::BinaryOp::logical_and ? 2 : 6;
  return Operator{strength, Operator::Form::binary, is_negative ? ast::BinaryOp::not_equal : word.op};
}

/// `(int) x`
bool Parser::at_cast() const {
  if (!at(left_paren) || kind(1) != identifier || kind(2) != right_paren || !on_same_line(3)) return false;
  auto const type = text(token(1));
  if (std::ranges::find(cast_types, type) == cast_types.end()) return false;
  bool const could_subtract = kind(3) == minus || kind(3) == plus;
  bool const is_primitive = type[0] >= 'a' && type[0] <= 'z';
  return starts_value(3) && kind(3) != left_brace && (is_primitive || !could_subtract);
}

ast::ExprPtr Parser::cast() {
  Nesting const nesting(*this);
  if (!nesting) {
    quiet_ = true;
    return broken();
  }
  auto const begin = advance().span.begin;
  auto type = identifier_of(advance());
  advance();
  auto operand = unary();
  return make(ast::Cast{std::move(operand), std::move(type)}, since(begin));
}

}  // namespace lapwing::dolphin
