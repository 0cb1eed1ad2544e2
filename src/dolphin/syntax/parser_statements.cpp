#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "dolphin/check/fixes.hpp"
#include "dolphin/syntax/internal/literals.hpp"
#include "dolphin/syntax/internal/parser_class.hpp"

namespace lapwing::dolphin {

using enum TokenKind;

namespace {

constexpr auto type_names =
    std::to_array<std::string_view>({"boolean", "byte", "char", "double", "float", "int", "long", "short", "void"});

/// Where two words stand alone, a capital letter makes the first one a type, as readers of Groovy expect.
bool is_type_name(std::string_view word) {
  return (word[0] >= 'A' && word[0] <= 'Z') || std::ranges::find(type_names, word) != type_names.end();
}

std::optional<ast::BinaryOp> compound(TokenKind kind) {
  switch (kind) {
    case plus_assign: return ast::BinaryOp::add;
    case minus_assign: return ast::BinaryOp::subtract;
    case times_assign: return ast::BinaryOp::multiply;
    case divide_assign: return ast::BinaryOp::divide;
    case remainder_assign: return ast::BinaryOp::remainder;
    case power_assign: return ast::BinaryOp::power;
    case shift_left_assign: return ast::BinaryOp::shift_left;
    case shift_right_assign: return ast::BinaryOp::shift_right;
    case bit_and_assign: return ast::BinaryOp::bit_and;
    case bit_xor_assign: return ast::BinaryOp::bit_xor;
    case bit_or_assign: return ast::BinaryOp::bit_or;
    default: return std::nullopt;
  }
}

bool is_assignment(TokenKind kind) {
  return kind == assign || compound(kind);
}

/// `move -5, 0, 0` reads as a subtraction; the name in front when `expr` looks like that.
ast::Name const* subtracted_from(ast::Expr const& expr) {
  auto const* binary = std::get_if<ast::Binary>(&expr.node);
  if (!binary || expr.in_parentheses) return nullptr;
  auto const* name = std::get_if<ast::Name>(&binary->left->node);
  if (name && binary->op == ast::BinaryOp::subtract) return name;
  return subtracted_from(*binary->left);
}

}  // namespace

ast::Block Parser::script() {
  return statements(end_of_file);
}

/// Up to `end`; kw_case stands for the end of one case of a switch.
ast::Block Parser::statements(TokenKind end) {
  ast::Block block;
  auto const begin = token().span.begin;
  bool const outer_quiet = quiet_;
  Lines const lines(newlines_matter_, true);
  while (true) {
    while (accept(semicolon)) {
    }
    if (at(end_of_file) || at(end)) break;
    if (end == kw_case && (at(kw_default) || at(right_brace))) break;
    if (end != end_of_file && (at(right_paren) || at(right_bracket) || at(right_brace) || at(interpolation_close)))
      break;
    statement_into(block);
  }
  quiet_ = outer_quiet;
  block.span = since(begin);
  return block;
}

void Parser::statement_into(ast::Block& block) {
  quiet_ = false;
  auto const first = next_;
  auto made = statement();
  if (at(comma) && made) {
    auto const* expr = std::get_if<ast::ExprStmt>(&made->node);
    if (auto const* name = expr ? subtracted_from(*expr->expr) : nullptr) {
      auto const span = expr->expr->span;
      auto const argument = diagnostics_.source().text(span).substr(name->text.size());
      auto const begin = argument.find_first_not_of(" \t");
      auto const word_end = span.begin + static_cast<std::uint32_t>(name->text.size());
      error(code("missing-parentheses"), span, fmt::format("this subtracts from '{}'", name->text),
            {fmt::format("write {} ({}), ...", name->text, argument.substr(begin)),
             argument_in_parentheses(diagnostics_.source(), {span.begin, word_end}, span)});
      made = nullptr;
    }
  }
  if (made) block.statements.push_back(std::move(made));
  if (!at_statement_end() || next_ == first) {
    unexpected_in_statement();
    skip_statement();
    if (next_ == first) advance();
  }
}

/// What stands behind a statement on its line; `1 + task 'a'` is a call that wants parentheses.
void Parser::unexpected_in_statement() {
  auto const* const before = next_ > 0 ? &tokens_[next_ - 1] : nullptr;
  if (before && before->kind == identifier && starts_argument(0)) {
    if (!quiet_) unread_.push_back(before->span);
    return expected("the end of the statement",
                    fmt::format("a call inside an expression needs parentheses: {}(...)", text(*before)));
  }
  if (before && before->kind == identifier && (at(logical_not) || at(tilde) || at(plus_plus) || at(minus_minus))) {
    if (!quiet_) unread_.push_back(before->span);
    return expected("the end of the statement", fmt::format("write {}({}...)", text(*before), text(token())));
  }
  expected("the end of the statement", at(colon) ? "a name before a colon is one word, such as a variable's" : "");
}

ast::StmtPtr Parser::statement() {
  Nesting const nesting(*this);
  if (!nesting) {
    quiet_ = true;
    return nullptr;
  }
  if (is_reserved_word(kind())) return keyword_statement();
  if (at_typed_declaration()) return declaration();
  if (at_foreign_declaration()) return foreign_declaration();
  if (at_foreign_function()) return foreign_function();
  if (at(identifier) && kind(1) == colon && !at_word("execute")) return labelled();
  return simple_statement();
}

ast::StmtPtr Parser::keyword_statement() {
  auto const begin = token().span.begin;
  switch (kind()) {
    case kw_def: return declaration();
    case kw_if: return if_statement();
    case kw_while: return while_statement();
    case kw_for: return for_statement();
    case kw_switch: return switch_statement();
    case kw_try: return try_statement();
    case kw_return: return return_statement();
    case kw_throw: return throw_statement();
    case kw_assert: return assert_statement();
    case kw_do: return do_statement();
    case kw_import: return import_statement();
    case kw_break: advance(); return make_statement(ast::Break{}, begin);
    case kw_continue: advance(); return make_statement(ast::Continue{}, begin);
    case kw_new:
    case kw_null:
    case kw_true:
    case kw_false: return simple_statement();
    default: return unsupported_statement();
  }
}

ast::StmtPtr Parser::unsupported_statement() {
  auto const& word = advance();
  if (word.kind == kw_else) {
    error(code("syntax"), word.span, "this else belongs to no if", "in oneOf and choose write otherwise task");
  } else if (word.kind == kw_catch || word.kind == kw_finally) {
    error(code("syntax"), word.span, fmt::format("this {} belongs to no try", text(word)));
  } else if (word.kind == kw_case || word.kind == kw_default) {
    error(code("syntax"), word.span, fmt::format("this {} belongs to no switch", text(word)));
  } else {
    error(code("unsupported-statement"), word.span, fmt::format("{} cannot begin a statement", text(word)));
  }
  // The body of a class is no code of ours: its braces are passed over unread.
  bool const is_foreign = word.kind == kw_class || word.kind == kw_interface || word.kind == kw_enum;
  while (is_foreign && !at_statement_end() && !at(left_brace)) advance();
  if (is_foreign && at(left_brace) && token().partner != Token::unclosed) next_ = token().partner + 1;
  return nullptr;
}

ast::StmtPtr Parser::simple_statement() {
  auto const begin = token().span.begin;
  if (at_unpacking_assignment()) return unpacking_assignment();
  auto expr = command();
  if (is_assignment(kind()) && on_same_line()) return assignment(std::move(expr), begin);
  return make_statement(ast::ExprStmt{std::move(expr)}, begin);
}

ast::StmtPtr Parser::assignment(ast::ExprPtr target, std::uint32_t begin) {
  auto const& sign = advance();
  assignable(*target);
  ast::Assign made{std::move(target), compound(sign.kind), command()};
  while (at(assign) && on_same_line() && !made.op) {  // a = b = 1
    assignable(*made.value);
    advance();
    made.more.push_back(std::move(made.value));
    made.value = command();
  }
  if (is_assignment(kind()) && on_same_line()) {
    error(code("syntax"), token().span, "one statement assigns once", "write each assignment on its own line");
    unread_.push_back(made.value->span);
  }
  return make_statement(std::move(made), begin);
}

void Parser::assignable(ast::Expr const& target) {
  bool const is_place =
      std::holds_alternative<ast::Name>(target.node) || std::holds_alternative<ast::Member>(target.node) ||
      std::holds_alternative<ast::Index>(target.node) || std::holds_alternative<ast::ErrorExpr>(target.node);
  if (is_place) return;
  error(code("not-assignable"), target.span, "nothing can be assigned to this",
        "assign to a variable, a member or an element");
}

/// `(a, b) = [b, a]`
bool Parser::at_unpacking_assignment() const {
  if (!at(left_paren) || kind(1) != identifier || token().partner == Token::unclosed) return false;
  auto const& after = tokens_[token().partner + 1];
  if (after.kind != assign || after.newline_before) return false;
  for (auto at = next_ + 1; at < token().partner; ++at) {
    if (tokens_[at].kind == comma) return true;
  }
  return false;
}

ast::StmtPtr Parser::unpacking_assignment() {
  auto const opener = next_;
  auto const begin = advance().span.begin;
  std::vector<ast::ExprPtr> targets;
  {
    Lines const lines(newlines_matter_, false);
    do {
      targets.push_back(postfix());
      assignable(*targets.back());
    } while (accept(comma));
    close(opener);
  }
  advance();
  ast::Assign made{std::move(targets.front()), std::nullopt, command()};
  targets.erase(targets.begin());
  made.more = std::move(targets);
  made.unpacks = true;
  return make_statement(std::move(made), begin);
}

/// `type: 'UAV'`: a field of a builder with a needless colon, which the checker judges (REC-10).
ast::StmtPtr Parser::labelled() {
  auto const begin = token().span.begin;
  auto const& word = advance();
  advance();
  bool const is_statement = is_reserved_word(kind()) && !starts_argument(0);
  if (is_statement || (at(identifier) && on_same_line() && starts_argument(1))) {
    error(code("label"), word.span, "labels are not part of the language");
    quiet_ = false;
    return statement();
  }
  ast::Call call;
  call.callee = make(ast::Name{std::string(text(word))}, word.span);
  call.arguments = arguments_until_line_end();
  call.style = ast::CallStyle::label;
  auto expr = make(std::move(call), since(begin));
  return make_statement(ast::ExprStmt{std::move(expr)}, begin);
}

// ---- declarations -------------------------------------------------------------------------------

bool Parser::at_typed_declaration() const {
  if (!at(identifier) || kind(1) != identifier || !on_same_line(1) || !is_type_name(text(token()))) return false;
  auto const& after = token(2);
  if (after.kind == left_paren && after.partner != Token::unclosed)
    return tokens_[after.partner + 1].kind == left_brace;
  return after.kind == assign || after.kind == semicolon || after.kind == end_of_file || after.kind == right_brace ||
         after.newline_before;
}

ast::StmtPtr Parser::declaration() {
  auto const begin = token().span.begin;
  std::optional<ast::Identifier> type;
  if (auto const& first = advance(); first.kind == identifier) type = identifier_of(first);
  if (!type && at_typed_declaration()) type = identifier_of(advance());  // def int n = 1
  if (at(left_paren)) return unpacking(begin);
  if (!at(identifier)) {
    expected("a name");
    return nullptr;
  }
  auto name = identifier_of(advance());
  if (at(left_paren) && on_same_line()) return function(std::move(name), begin);
  if (at(left_brace) && on_same_line()) {
    expected("'(' and the parameters",
             fmt::format("write def {}() {{ ... }}, or def {} = {{ ... }}", name.text, name.text));
    unread_.push_back(name.span);
    return nullptr;
  }
  ast::VarDecl made{.type = std::move(type), .names = {}, .value = nullptr};
  made.names.push_back(std::move(name));
  while (at(comma) && kind(1) == identifier && kind(2) != assign) {
    advance();
    made.names.push_back(identifier_of(advance()));
  }
  if (made.names.size() == 1 && accept(assign)) made.value = command();
  if (made.value && at(assign) && on_same_line()) {
    error(code("syntax"), token().span, "one declaration gives one variable a value",
          fmt::format("write {} = ... on a line of its own", diagnostics_.source().text(made.value->span)));
    unread_.push_back(made.value->span);
  }
  if (at(comma))
    error(code("syntax"), token().span, "one declaration gives one variable a value", "write each on its own line");
  return make_statement(std::move(made), begin);
}

ast::StmtPtr Parser::unpacking(std::uint32_t begin) {
  ast::VarDecl made;
  made.unpacks = true;
  auto const opener = next_;
  advance();
  {
    Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed);
    while (at(identifier)) {
      if (kind(1) == identifier) advance();  // def (int a, int b)
      made.names.push_back(identifier_of(advance()));
      if (!accept(comma)) break;
    }
    close(opener);
  }
  if (expect(assign, "'=' and a list")) made.value = command();
  return make_statement(std::move(made), begin);
}

ast::StmtPtr Parser::function(ast::Identifier name, std::uint32_t begin) {
  ast::FunctionDecl made;
  made.name = std::move(name);
  auto const opener = next_;
  advance();
  {
    Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed);
    made.parameters = parameters(right_paren);
    close(opener);
  }
  made.body = braces("'{' and the body of the function");
  return make_statement(std::move(made), begin);
}

/// `a, int b, c = 2`.
std::vector<ast::Parameter> Parser::parameters(TokenKind end) {
  std::vector<ast::Parameter> out;
  while (!at(end) && !at(end_of_file)) {
    ast::Parameter made;
    bool const has_type = kind(1) == identifier && (at(identifier) || at(kw_def));
    if (has_type && at(identifier)) made.type = identifier_of(token());
    if (has_type) advance();
    if (!at(identifier)) {
      expected("the name of a parameter");
      break;
    }
    made.name = identifier_of(advance());
    if (accept(assign)) made.fallback = expression();
    if (!made.fallback && !out.empty() && out.back().fallback) {
      error(code("syntax"), made.name.span, "a parameter without a default cannot follow one that has a default",
            "put those with defaults last");
    }
    out.push_back(std::move(made));
    if (!accept(comma)) break;
  }
  return out;
}

}  // namespace lapwing::dolphin
