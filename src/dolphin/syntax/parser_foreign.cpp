#include <fmt/format.h>

#include <string>
#include <utility>

#include "dolphin/names/foreign_words.hpp"
#include "dolphin/syntax/internal/parser_class.hpp"

/// What people write who come from other languages: said with the spelling of this one, and read as what was meant, so
/// that nothing else is wrong because of it.
namespace lapwing::dolphin {

using enum TokenKind;

std::string Parser::hint_for_place() const {
  if (next_ == 0) return {};
  auto const& before = tokens_[next_ - 1];
  bool const is_number = before.kind == integer || before.kind == decimal;
  if (is_number && at(identifier) && on_same_line()) {
    bool const is_speed = at_word("m") && kind(1) == slash && at_word("s", 2);
    if (is_speed) return fmt::format("speeds are metres a second: write {}", text(before));
    auto const unit = unit_meant(text(token()));
    if (!unit.empty()) return fmt::format("write {}.{}", text(before), unit);
  }
  bool const is_arrow = at(arrow) || (on_same_line() && (at_word("then") || at_word("andThen")));
  if (is_arrow) return "tasks are joined by >>, one after the other, and by |, both at once";
  return {};
}

/// `var x = 1`, `val x: Int = 1`, `final int x = 1`
bool Parser::at_foreign_declaration() const {
  if (!at(identifier) || !declares_variable(text(token())) || kind(1) != identifier || !on_same_line(1)) return false;
  auto const after = kind(2) == identifier ? kind(3) : kind(2);
  return after == assign || after == colon;
}

ast::StmtPtr Parser::foreign_declaration() {
  auto const& word = advance();
  if (kind(1) == identifier) advance();  // the type
  ast::VarDecl made{.type = {}, .names = {identifier_of(advance())}, .value = nullptr};
  error(code("unsupported-statement"), word.span, fmt::format("{} is not part of the language", text(word)),
        fmt::format("write def {} = ...", made.names[0].text));
  if (accept(colon)) advance();  // val x: Int
  if (accept(assign)) made.value = command();
  return make_statement(std::move(made), word.span.begin);
}

/// `function f(x) { ... }`
bool Parser::at_foreign_function() const {
  return at(identifier) && declares_function(text(token())) && kind(1) == identifier && on_same_line(1) &&
         kind(2) == left_paren && token(2).partner != Token::unclosed;
}

ast::StmtPtr Parser::foreign_function() {
  auto const& word = advance();
  auto name = identifier_of(advance());
  auto const parameters = diagnostics_.source().text({token().span.begin, tokens_[token().partner].span.end});
  error(code("unsupported-statement"), word.span, fmt::format("{} is not part of the language", text(word)),
        fmt::format("write def {}{} {{ ... }}", name.text, parameters));
  return function(std::move(name), word.span.begin);
}

/// `if x > 3 {` and `if x > 3:`. Steps behind the condition, unread.
ast::ExprPtr Parser::bare_condition(std::string_view keyword, std::uint32_t begin) {
  while (!at(left_brace) && !at_statement_end()) {
    if (at(colon) && token(1).newline_before) break;
    auto const partner = token().partner;
    next_ = partner != Token::unclosed && partner > next_ ? partner + 1 : next_ + 1;
  }
  auto const condition = since(begin);
  error(code("syntax"), condition, "the whole condition stands in parentheses",
        fmt::format("write {} ({}) {{ ... }}", keyword, diagnostics_.source().text(condition)));
  unread_.push_back(condition);
  return broken();
}

/// `for x in list {`
ast::StmtPtr Parser::bare_for(std::uint32_t begin) {
  if (!at(identifier) || kind(1) != kw_in) {
    expected("'(' after for", "write for (x in list) { ... }");
    return nullptr;
  }
  ast::ForIn made;
  auto const first = token().span.begin;
  made.variable = identifier_of(advance());
  advance();
  made.iterable = bare_condition("for", first);
  if (!accept(colon) && !at(left_brace)) return nullptr;
  made.body = block();
  return make_statement(std::move(made), begin);
}

}  // namespace lapwing::dolphin
