#include "dolphin/services/values.hpp"

#include <algorithm>

#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;

/// The innermost expression that ends at one place, or the outermost one inside one pair of parentheses.
class Search {
 public:
  Search(std::uint32_t end, Span parentheses) : end_(end), parentheses_(parentheses) {}

  void operator()(ast::Stmt const& one) { ast::for_each_child(one.node, *this); }
  void operator()(ast::Expr const& one) {
    if (one.span.end == end_) found = &one;
    bool const is_inside = parentheses_.begin < one.span.begin && one.span.end < parentheses_.end;
    if (one.in_parentheses && is_inside && !in_parentheses) in_parentheses = &one;
    ast::for_each_child(one.node, *this);
  }

  ast::Expr const* found = nullptr;
  ast::Expr const* in_parentheses = nullptr;

 private:
  std::uint32_t end_;
  Span parentheses_;
};

Facts facts_of_token(Document const& document, Token const& token) {
  switch (token.kind) {
    case TokenKind::integer: return {Kind::integer, Dimension::none};
    case TokenKind::decimal: return {Kind::decimal, Dimension::none};
    case TokenKind::string:
    case TokenKind::string_close: return {Kind::text, {}};
    default: break;
  }
  auto const& globals = document.resolution().globals;
  auto const found = globals.find(document.text(token.span));
  return found == globals.end() ? Facts{} : document.facts(*found->second);
}

}  // namespace

Facts facts_of_value_before(Document const& document, std::size_t point) {
  if (point == 0) return {};
  auto const& tokens = document.stream().tokens;
  auto const& last = tokens[point - 1];
  Span parentheses;
  if (last.kind == TokenKind::right_paren && last.partner != Token::unclosed) {
    // Spans leave parentheses out: what is looked for lies between them, and touches neither.
    parentheses = {tokens[last.partner].span.begin, last.span.end};
  }
  Search search(last.span.end, parentheses);
  for (auto const& one : document.program().body.statements) search(*one);
  if (search.found) return document.facts(*search.found);
  if (search.in_parentheses) return document.facts(*search.in_parentheses);
  return facts_of_token(document, last);
}

}  // namespace lapwing::dolphin
