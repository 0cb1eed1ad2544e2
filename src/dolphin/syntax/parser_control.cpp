#include <fmt/format.h>

#include <utility>

#include "dolphin/syntax/internal/parser_class.hpp"

namespace lapwing::dolphin {

using enum TokenKind;

ast::ExprPtr Parser::condition(std::string_view keyword, std::string_view what) {
  auto const begin = token().span.begin;
  if (at(left_paren)) {
    auto made = in_parentheses();
    // `if (a) && (b) { }`: the parentheses hold only a part of it.
    bool const goes_on = on_same_line() && kind() >= equal && kind() <= bit_xor && !at(logical_not);
    return goes_on && !quiet_ ? bare_condition(keyword, begin) : std::move(made);
  }
  if (!quiet_ && starts_value(0) && on_same_line()) return bare_condition(keyword, begin);
  expected(fmt::format("'(' and {}", what));
  return broken();
}

ast::Block Parser::block() {
  if (at(left_brace)) return braces("'{'");
  ast::Block block;
  auto const begin = token().span.begin;
  if (!at(semicolon)) {
    if (auto made = statement()) block.statements.push_back(std::move(made));
  }
  block.span = since(begin);
  return block;
}

ast::Block Parser::braces(std::string_view what) {
  if (!at(left_brace)) {
    expected(what, at(colon) ? "a block stands in braces: { ... }" : "");
    return {};
  }
  auto const opener = next_;
  auto const begin = advance().span.begin;
  auto block = statements(right_brace);
  close(opener);
  block.span = since(begin);
  return block;
}

ast::StmtPtr Parser::if_statement() {
  auto const begin = advance().span.begin;
  ast::If made;
  made.condition = condition("if", "a condition");
  bool const was_colon = quiet_ && accept(colon);  // as in Python: what is below is read all the same
  if (quiet_ && !was_colon && !at(left_brace)) return make_statement(std::move(made), begin);
  made.then = block();
  if (at(semicolon) && kind(1) == kw_else) advance();
  if (at_else_if_word()) {
    error(code("syntax"), token().span, fmt::format("{} is not part of the language", text(token())),
          "write else if (...) { ... }");
    made.otherwise = ast::Block{};
    made.otherwise->statements.push_back(if_statement());
    return make_statement(std::move(made), begin);
  }
  if (accept(kw_else)) {
    if (was_colon) accept(colon);
    made.otherwise = block();
  }
  return make_statement(std::move(made), begin);
}

bool Parser::at_else_if_word() const {
  return at_word("elif") || at_word("elsif") || at_word("elseif");
}

ast::StmtPtr Parser::while_statement() {
  auto const begin = advance().span.begin;
  ast::While made;
  made.condition = condition("while", "a condition");
  bool const was_colon = quiet_ && accept(colon);
  if (quiet_ && !was_colon && !at(left_brace)) return make_statement(std::move(made), begin);
  made.body = block();
  return make_statement(std::move(made), begin);
}

/// `do { ... } while (condition)`
ast::StmtPtr Parser::do_statement() {
  auto const word = advance().span;
  ast::While made;
  made.body_first = true;
  made.body = block();
  accept(semicolon);
  if (!accept(kw_while)) {
    error(code("syntax"), word, "do needs a while behind its block", "write do { ... } while (condition)");
    return nullptr;
  }
  made.condition = condition("while", "a condition");
  return make_statement(std::move(made), word.begin);
}

ast::StmtPtr Parser::for_statement() {
  auto const begin = advance().span.begin;
  if (!at(left_paren)) return bare_for(begin);
  auto const opener = next_;
  advance();
  auto const typed = kind(1) == identifier && (at(identifier) || at(kw_def)) ? std::size_t{1} : std::size_t{0};
  if (kind(typed + 1) == kw_in || kind(typed + 1) == colon) return for_in(opener, begin);
  ast::For made;
  {
    Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed);
    if (!at(semicolon)) made.init = statement();
    if (expect(semicolon, "';'") && !at(semicolon)) made.condition = expression();
    if (expect(semicolon, "';'") && !at(right_paren)) made.update = simple_statement();
    close(opener);
  }
  made.body = block();
  return make_statement(std::move(made), begin);
}

ast::StmtPtr Parser::for_in(std::size_t opener, std::uint32_t begin) {
  ast::ForIn made;
  {
    Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed);
    if (kind(1) == identifier) advance();  // the type
    made.variable = identifier_of(advance());
    advance();
    made.iterable = command();
    close(opener);
  }
  made.body = block();
  return make_statement(std::move(made), begin);
}

ast::StmtPtr Parser::switch_statement() {
  auto const begin = advance().span.begin;
  ast::Switch made;
  made.subject = condition("switch", "a value");
  if (!at(left_brace)) {
    expected("'{' and cases");
    return make_statement(std::move(made), begin);
  }
  auto const opener = next_;
  advance();
  while (at(kw_case) || at(kw_default)) made.cases.push_back(switch_case());
  close(opener);
  return make_statement(std::move(made), begin);
}

ast::SwitchCase Parser::switch_case() {
  ast::SwitchCase made;
  quiet_ = false;
  if (advance().kind == kw_case) made.value = expression();
  expect(colon, "':'");
  made.body = statements(kw_case);
  return made;
}

ast::StmtPtr Parser::try_statement() {
  auto const begin = advance().span.begin;
  ast::Try made;
  made.body = braces("'{'");
  while (at(kw_catch)) made.catches.push_back(catch_clause());
  if (accept(kw_finally)) made.finally = braces("'{'");
  if (made.catches.empty() && !made.finally) {
    error(code("syntax"), {begin, begin + 3}, "try needs catch or finally", "add catch (e) { ... }");
  }
  return make_statement(std::move(made), begin);
}

/// `catch (e)`, `catch (TaskError e)`, `catch (A | B e)`.
ast::Catch Parser::catch_clause() {
  ast::Catch made;
  advance();
  auto const opener = next_;
  if (expect(left_paren, "'(' and the name of the error")) {
    Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed);
    while (at(identifier) && (kind(1) == identifier || kind(1) == bit_or || kind(1) == dot)) {
      made.types.push_back(identifier_of(advance()));
      while (accept(dot)) made.types.back() = identifier_of(advance());  // java.lang.Exception is Exception
      accept(bit_or);
    }
    if (at(identifier)) {
      made.name = identifier_of(advance());
    } else {
      expected("the name of the error");
    }
    close(opener);
  }
  made.body = braces("'{'");
  return made;
}

ast::StmtPtr Parser::return_statement() {
  auto const begin = advance().span.begin;
  ast::Return made;
  if (!at_statement_end()) made.value = command();
  return make_statement(std::move(made), begin);
}

ast::StmtPtr Parser::throw_statement() {
  auto const begin = advance().span.begin;
  return make_statement(ast::Throw{expression()}, begin);
}

ast::StmtPtr Parser::assert_statement() {
  auto const begin = advance().span.begin;
  ast::Assert made{expression(), nullptr};
  if (accept(colon) || accept(comma)) made.message = expression();
  return make_statement(std::move(made), begin);
}

ast::StmtPtr Parser::import_statement() {
  auto const begin = advance().span.begin;
  if (at_word("static")) advance();
  auto const path = token().span.begin;
  while (!at_statement_end()) advance();
  auto text = std::string(diagnostics_.source().text(since(path)));
  auto made = make_statement(ast::Import{std::move(text)}, begin);
  diagnostics_.report(code("needless-import"), since(begin), "imports are not needed and do nothing");
  return made;
}

}  // namespace lapwing::dolphin
