#include "dolphin/syntax/parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dolphin/syntax/ast_walk.hpp"
#include "dolphin/syntax/internal/parser_class.hpp"
#include "dolphin/syntax/lexer.hpp"

namespace lapwing::dolphin {

using base::Span;
using enum TokenKind;

namespace {

/// The height of a tree with this node on top.
template <class Node>
std::uint16_t height_of(Node const& node) {
  std::uint16_t below = 0;
  ast::for_each_child(node, [&](auto const& child) { below = std::max(below, child.height); });
  return static_cast<std::uint16_t>(below + 1);
}

bool is_closing(TokenKind kind) {
  return kind == right_paren || kind == right_bracket || kind == right_brace || kind == interpolation_close ||
         kind == string_close;
}

/// A line that ends with one of these goes on in the next.
bool asks_for_more(TokenKind kind) {
  bool const is_step = kind == plus_plus || kind == minus_minus;
  return kind == comma || kind == colon || kind == dot || (kind >= range && kind <= bit_xor && !is_step);
}

}  // namespace

Nesting::Nesting(Parser& parser) : parser_(parser) {
  ++parser_.depth_;
  if (*this || parser_.depth_reported_) return;
  parser_.depth_reported_ = true;
  parser_.quiet_ = false;
  parser_.error(code("nested-too-deeply"), parser_.token().span,
                fmt::format("this is nested too deeply: at most {} levels are read", ast::max_tree_height),
                "name parts of it with variables or functions");
}

// ---- tokens -------------------------------------------------------------------------------------

Token const& Parser::token(std::size_t ahead) const {
  return tokens_[std::min(next_ + ahead, tokens_.size() - 1)];
}

bool Parser::at_word(std::string_view word, std::size_t ahead) const {
  return kind(ahead) == identifier && text(token(ahead)) == word;
}

Token const& Parser::advance() {
  auto const& taken = token();
  if (next_ + 1 < tokens_.size()) ++next_;
  return taken;
}

bool Parser::accept(TokenKind wanted) {
  if (!at(wanted)) return false;
  advance();
  return true;
}

ast::Identifier Parser::identifier_of(Token const& token) const {
  return {std::string(text(token)), token.span};
}

Span Parser::since(std::uint32_t begin) const {
  auto const end = next_ > 0 ? tokens_[next_ - 1].span.end : begin;
  return {begin, std::max(begin, end)};
}

Span Parser::here() const {
  bool const behind_line = at(end_of_file) || (newlines_matter_ && token().newline_before);
  if (!behind_line || next_ == 0) return token().span;
  auto const end = tokens_[next_ - 1].span.end;
  return {end, end};
}

// ---- mistakes -----------------------------------------------------------------------------------

void Parser::error(base::DiagnosticKind const& kind, Span span, std::string message, base::Hint hint) {
  if (std::exchange(quiet_, true)) return;
  diagnostics_.report(kind, span, std::move(message), std::move(hint));
}

std::string Parser::describe(Token const& token) const {
  if (token.kind == end_of_file) return "the end of the script";
  if (newlines_matter_ && token.newline_before) return "the end of the line";
  if (token.kind == interpolation_close || token.kind == string_close) return "the end of the string";
  if (token.kind == string || token.kind == string_open) return "a string";
  return fmt::format("'{}'", text(token));
}

void Parser::expected(std::string_view what, base::Hint hint) {
  if (at(invalid)) quiet_ = true;  // the lexer has complained
  if (hint.empty()) hint = hint_for_place();
  error(code("syntax"), here(), fmt::format("expected {}, found {}", what, describe(token())), std::move(hint));
}

bool Parser::expect(TokenKind wanted, std::string_view what) {
  if (accept(wanted)) return true;
  expected(what);
  return false;
}

ast::ExprPtr Parser::broken() {
  auto out = std::make_unique<ast::Expr>();
  out->span = token().span;
  return out;
}

// ---- brackets and lines -------------------------------------------------------------------------

bool Parser::at_statement_end() const {
  return at(end_of_file) || at(semicolon) || is_closing(kind()) || (newlines_matter_ && token().newline_before);
}

void Parser::close(std::size_t opener) {
  auto const partner = tokens_[opener].partner;
  if (partner == Token::unclosed) return;
  if (next_ < partner) {
    auto const closer = text(tokens_[partner]);
    expected(fmt::format("'{}'", closer.empty() ? "}" : closer));
    unread_.push_back({token().span.begin, tokens_[partner].span.begin});
    quiet_ = false;
  }
  next_ = partner;
  advance();
}

/// Also over the lines that continue the broken one. Closures on the way are read for their own mistakes.
void Parser::skip_statement() {
  auto const first = next_;
  while (!at(end_of_file) && !at(semicolon) && !is_closing(kind())) {
    bool const goes_on = !token().newline_before || next_ == first || asks_for_more(tokens_[next_ - 1].kind) ||
                         operator_continues() || at_word("then") || at_word("run") || at_word("onError");
    if (!goes_on) break;
    if (at(left_brace) && depth_ + 8 < ast::max_tree_height) {
      closure();
    } else if (auto const partner = token().partner; partner != Token::unclosed && partner > next_) {
      next_ = partner + 1;
    } else {
      ++next_;
    }
  }
  unread_.push_back(since(tokens_[first].span.begin));
}

// ---- nodes --------------------------------------------------------------------------------------

ast::ExprPtr Parser::make(ast::Expr::Node node, Span span) {
  auto out = std::make_unique<ast::Expr>();
  auto const height = height_of(node);
  out->span = span;
  if (height > ast::max_tree_height) {
    error(code("nested-too-deeply"), span,
          fmt::format("this expression is too long: at most {} operators follow each other", ast::max_tree_height),
          "name parts of it with variables");
    return out;
  }
  out->node = std::move(node);
  out->height = height;
  return out;
}

ast::StmtPtr Parser::make_statement(ast::Stmt::Node node, std::uint32_t begin) {
  auto const height = height_of(node);
  if (height > ast::max_tree_height) {
    error(code("nested-too-deeply"), since(begin),
          fmt::format("this is nested too deeply: at most {} levels are read", ast::max_tree_height));
    return nullptr;
  }
  auto out = std::make_unique<ast::Stmt>();
  out->node = std::move(node);
  out->span = since(begin);
  out->height = height;
  return out;
}

ast::Program parse(base::Diagnostics& diagnostics, std::span<std::string_view const> instructions) {
  auto stream = lex(diagnostics);
  Parser parser(stream.tokens, diagnostics, instructions);
  ast::Program program;
  program.body = parser.script();
  program.comments = std::move(stream.comments);
  program.unread = parser.unread();
  return program;
}

}  // namespace lapwing::dolphin
