#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "dolphin/check/fixes.hpp"
#include "dolphin/syntax/internal/literals.hpp"
#include "dolphin/syntax/internal/parser_class.hpp"

namespace lapwing::dolphin {

using base::Span;
using enum TokenKind;

namespace {

struct ChainWords {
  ast::ChainKind kind;
  std::string_view head;
  std::string_view word;
  std::string_view pattern;
};
constexpr auto chains = std::to_array<ChainWords>({
    {ast::ChainKind::wait_for, "waitFor", "then", "waitFor { condition } then task"},
    {ast::ChainKind::when, "when", "then", "when { condition } then task"},
    {ast::ChainKind::until, "until", "run", "until { condition } run task"},
    {ast::ChainKind::during, "during", "run", "during 30.seconds run task"},
    {ast::ChainKind::watch, "watch", "onError", "watch task onError { ... }"},
});

ChainWords const& words_of(ast::ChainKind kind) {
  return *std::ranges::find(chains, kind, &ChainWords::kind);
}

/// Words between two operands: never the first argument of a command call.
bool is_chain_word(std::string_view word) {
  return word == "then" || word == "run" || word == "onError" || word == "during";
}

/// Instructions without a value: `message (1) + 2` can only mean `message ((1) + 2)`, and `execute (a | b)[v]` the
/// restricted task (REC-9).
constexpr auto void_instructions = std::to_array<std::string_view>(
    {"execute", "halt", "message", "pause", "post", "print", "println", "release", "setConnectionTimeout"});

bool is_closing_bracket(TokenKind kind) {
  return kind == right_paren || kind == right_bracket || kind == right_brace || kind == interpolation_close;
}

bool joins_values(TokenKind kind) {
  return (kind >= plus && kind <= power) || (kind >= shift_left && kind <= bit_xor && kind != logical_not);
}

}  // namespace

// ---- command calls ------------------------------------------------------------------------------

/// An expression where a call may go without parentheses: a statement, the right side of = and return, the inside of
/// parentheses.
ast::ExprPtr Parser::command() {
  auto const begin = token().span.begin;
  if (at_wrapped_argument()) return wrapped_argument();
  auto const callee = command_callee_size();
  return misplaced_chain_word(callee > 0 ? command_call(callee) : expression(), begin);
}

/// The number of tokens of the name or dotted path that begins here, else 0.
std::size_t Parser::path_size() const {
  if (!at(identifier) || chain_head() || at_otherwise()) return 0;
  std::size_t size = 1;
  while (kind(size) == dot && (kind(size + 1) == identifier || is_reserved_word(kind(size + 1))) &&
         on_same_line(size + 1))
    size += 2;
  return size;
}

/// The number of tokens of the callee when a command call begins here, else 0.
std::size_t Parser::command_callee_size() const {
  auto const size = path_size();
  if (size == 0) return 0;
  if (starts_argument(size) || at_bracketed_first_argument(size)) return size;
  bool const takes_names_below = size == 1 && (at_word("execute") || at_word("setConnectionTimeout"));
  return takes_names_below && token(1).newline_before && at_argument_name(1) ? 1 : 0;  // REC-7f
}

bool Parser::starts_argument(std::size_t ahead) const {
  if (!on_same_line(ahead)) return false;
  if (at_argument_name(ahead)) return true;
  switch (kind(ahead)) {
    case identifier: return (!is_chain_word(text(token(ahead))) && !at_joining_word(ahead)) || at_during_chain(ahead);
    case integer:
    case decimal:
    case string:
    case string_open:
    case kw_true:
    case kw_false:
    case kw_null:
    case kw_new: return true;
    default: return false;
  }
}

/// `execute during 5.seconds run t`: a chain as argument, and not the old `task during 5.seconds`.
bool Parser::at_during_chain(std::size_t ahead) const {
  if (!at_word("during", ahead)) return false;
  for (auto at = next_ + ahead + 1; at < tokens_.size(); ++at) {
    auto const& token = tokens_[at];
    bool const is_run = token.kind == identifier && text(token) == "run";
    if (is_run) return true;
    if (token.newline_before || token.kind == comma || token.kind == semicolon || is_closing_bracket(token.kind)) {
      return false;
    }
    bool const opens = token.kind == left_paren || token.kind == left_bracket || token.kind == left_brace;
    if (opens && token.partner == Token::unclosed) return false;
    if (opens) at = token.partner;
  }
  return false;
}

/// `move (-5), 0, 0`: the comma tells that the parentheses hold only the first of several arguments.
bool Parser::at_bracketed_first_argument(std::size_t ahead) const {
  auto const& open = token(ahead);
  if (open.kind != left_paren || !open.blank_before || !on_same_line(ahead)) return false;
  if (open.partner == Token::unclosed) return false;
  auto const& after = tokens_[open.partner + 1];
  return after.kind == comma && !after.newline_before;
}

bool Parser::at_argument_name(std::size_t ahead) const {
  return kind(ahead + 1) == colon &&
         (kind(ahead) == identifier || kind(ahead) == string || is_reserved_word(kind(ahead)));
}

ast::ExprPtr Parser::callee_path(std::size_t size) {
  auto const begin = token().span.begin;
  auto const& first = advance();
  auto callee = make(ast::Name{std::string(text(first))}, first.span);
  for (std::size_t i = 1; i < size; i += 2) {
    advance();
    auto name = identifier_of(advance());
    callee = make(ast::Member{std::move(callee), std::move(name)}, since(begin));
  }
  return callee;
}

ast::ExprPtr Parser::command_call(std::size_t callee_size) {
  auto const begin = token().span.begin;
  ast::Call made;
  made.callee = callee_path(callee_size);
  auto const is_void = callee_size == 1 && is_void_instruction(text(tokens_[next_ - 1]));
  made.arguments = arguments_until_line_end();
  if (is_void) {
    auto& last = made.arguments.back().value;
    auto const last_begin = last->span.begin;
    last = misplaced_chain_word(std::move(last), last_begin);
  }
  made.style = ast::CallStyle::command;
  return make(std::move(made), since(begin));
}

std::vector<ast::Argument> Parser::arguments_until_line_end() {
  std::vector<ast::Argument> out;
  do {
    out.push_back(argument());
  } while (accept(comma));
  return out;
}

ast::Argument Parser::argument() {
  ast::Argument made;
  if (at_argument_name()) {
    auto const& word = advance();
    made.name = identifier_of(word);
    if (word.kind == string) {
      Span const inside{word.span.begin + 1, std::max(word.span.begin + 1, word.span.end - 1)};
      made.name->text = decode_string(inside, diagnostics_);
    }
    advance();
  }
  auto const begin = token().span.begin;
  made.value = expression();
  if (made.name) made.value = misplaced_chain_word(std::move(made.value), begin);
  return made;
}

bool Parser::is_void_instruction(std::string_view word) const {
  return std::ranges::find(void_instructions, word) != void_instructions.end() ||
         std::ranges::find(instructions_, word) != instructions_.end();
}

bool Parser::at_wrapped_argument() const {
  if (!at(identifier) || kind(1) != left_paren || !on_same_line(1) || !token(1).blank_before) return false;
  if (token(1).partner == Token::unclosed || !is_void_instruction(text(token()))) {
    return false;
  }
  auto const& after = tokens_[token(1).partner + 1];
  bool const continues = !newlines_matter_ || !after.newline_before || (after.kind != plus && after.kind != minus);
  bool const goes_on_with_it =
      (after.kind == dot || after.kind == spread_dot || after.kind == left_bracket) && !after.newline_before;
  return goes_on_with_it || (joins_values(after.kind) && continues);
}

ast::ExprPtr Parser::wrapped_argument() {
  auto const begin = token().span.begin;
  ast::Call made;
  made.callee = callee_path(1);
  auto const name = text(tokens_[next_ - 1]);
  made.arguments = arguments_until_line_end();
  auto const argument = made.arguments.front().value->span;
  base::Hint hint(fmt::format("write {}(...) round it", name));
  if (made.arguments.size() == 1) hint.fix = with_parentheses(made.callee->span, argument);
  diagnostics_.report(code("whole-argument"), argument, fmt::format("all of this is taken as the argument of {}", name),
                      std::move(hint));
  return make(std::move(made), since(begin));
}

/// `task 't1' during 2.seconds` is read as `during 2.seconds run (task 't1')`; the other chain words need their head.
ast::ExprPtr Parser::misplaced_chain_word(ast::ExprPtr left, std::uint32_t begin) {
  while (at_word("during") && on_same_line() && !quiet_) {
    auto const head = advance().span;
    auto limit = expression();
    diagnostics_.report(code("legacy-spelling"), head, "'during' belongs in front of its task",
                        in_front(diagnostics_.source(), head, since(begin)));
    left = make(ast::Chain{ast::ChainKind::during, std::move(limit), std::move(left), head}, since(begin));
  }
  return left;
}

// ---- postfix ------------------------------------------------------------------------------------

ast::ExprPtr Parser::postfix() {
  auto const begin = token().span.begin;
  return postfix_of(primary(), begin);
}

ast::ExprPtr Parser::postfix_of(ast::ExprPtr object, std::uint32_t begin) {
  while (true) {
    bool const adjacent = !newlines_matter_ || on_same_line();
    bool const callable = std::holds_alternative<ast::Name>(object->node) ||
                          std::holds_alternative<ast::Member>(object->node) ||
                          std::holds_alternative<ast::Call>(object->node);
    if ((at(dot) || at(safe_dot) || at(spread_dot)) && operator_continues()) {
      if (quiet_) return object;
      object = member(std::move(object), begin);
    } else if (at(left_paren) && adjacent) {
      object = call(std::move(object), begin);
    } else if (at(left_bracket) && adjacent) {
      object = index(std::move(object), begin);
    } else if (at(left_brace) && on_same_line() && callable) {
      object = trailing_closure(std::move(object), begin);
    } else if ((at(plus_plus) || at(minus_minus)) && on_same_line()) {
      int const by = advance().kind == plus_plus ? 1 : -1;
      object = make(ast::Step{std::move(object), by, false}, since(begin));
    } else {
      return object;
    }
  }
}

ast::ExprPtr Parser::member(ast::ExprPtr object, std::uint32_t begin) {
  auto const point = advance().kind;
  if (!at(identifier) && !is_reserved_word(kind())) {
    unread_.push_back(object->span);
    expected("a name after the point", at(integer) ? fmt::format("write 0.{}", text(token())) : "");
    return object;
  }
  auto name = identifier_of(advance());
  return make(ast::Member{std::move(object), std::move(name), point == safe_dot, point == spread_dot}, since(begin));
}

std::vector<ast::Argument> Parser::arguments_in_parentheses() {
  std::vector<ast::Argument> out;
  auto const opener = next_;
  advance();
  Lines const lines(newlines_matter_, tokens_[opener].partner == Token::unclosed && newlines_matter_);
  while (!at(right_paren) && !at_statement_end()) {
    auto const begin = token().span.begin;
    // `message (poll 'x')`: a command call may stand directly inside parentheses (REC-8), and takes what follows.
    auto const path = at_argument_name() ? 0 : path_size();
    bool const is_command = path > 0 && starts_argument(path);
    auto made = is_command ? ast::Argument{std::nullopt, command_call(path)} : argument();
    made.value = misplaced_chain_word(std::move(made.value), begin);
    out.push_back(std::move(made));
    if (!accept(comma)) break;
  }
  close(opener);
  return out;
}

/// `t.during(10.seconds)` is an old spelling of a chain, everything else a call.
ast::ExprPtr Parser::call(ast::ExprPtr callee, std::uint32_t begin) {
  auto arguments = arguments_in_parentheses();
  auto* old = std::get_if<ast::Member>(&callee->node);
  if (old && old->name.text == "during" && arguments.size() == 1) {
    diagnostics_.report(code("legacy-spelling"), old->name.span, "'during' belongs in front of its task",
                        in_front(diagnostics_.source(), old->name.span, since(begin)));
    auto const head = old->name.span;
    auto task = std::move(old->object);
    return make(ast::Chain{ast::ChainKind::during, std::move(arguments[0].value), std::move(task), head}, since(begin));
  }
  return make(ast::Call{std::move(callee), std::move(arguments)}, since(begin));
}

ast::ExprPtr Parser::trailing_closure(ast::ExprPtr callee, std::uint32_t begin) {
  ast::Argument last{std::nullopt, closure()};
  if (auto* call = std::get_if<ast::Call>(&callee->node); call && !callee->in_parentheses) {
    // In place: `f {} {} {} ...` is one call, however long.
    callee->height = std::max<std::uint16_t>(callee->height, last.value->height + 1);
    call->arguments.push_back(std::move(last));
    callee->span = since(begin);
    return callee;
  }
  ast::Call made;
  made.callee = std::move(callee);
  made.arguments.push_back(std::move(last));
  return make(std::move(made), since(begin));
}

/// `imcPlan['survey1']`, printed so in the report that describes the language, is a call. Several indices are a list.
ast::ExprPtr Parser::index(ast::ExprPtr object, std::uint32_t begin) {
  auto inside = list_or_map();
  if (auto* list = std::get_if<ast::ListLiteral>(&inside->node)) {
    if (list->items.empty()) error(code("syntax"), inside->span, "an index is missing");
    if (list->items.size() == 1) inside = ast::ExprPtr(std::move(list->items.front()));
  }
  if (auto const* name = std::get_if<ast::Name>(&object->node); name && name->text == "imcPlan") {
    ast::Call made;
    made.callee = std::move(object);
    made.arguments.push_back({std::nullopt, std::move(inside)});
    return make(std::move(made), since(begin));
  }
  return make(ast::Index{std::move(object), std::move(inside)}, since(begin));
}

// ---- chains -------------------------------------------------------------------------------------

/// Whether a chain begins here; the heads are words like others where nothing follows that a chain could begin with.
std::optional<ast::ChainKind> Parser::chain_head() const {
  auto const found = std::ranges::find_if(chains, [&](ChainWords const& words) { return at_word(words.head); });
  if (found == chains.end() || !on_same_line(1)) return std::nullopt;
  bool const opens = kind(1) == left_brace || kind(1) == left_paren;
  if (!opens && (kind(1) == colon || kind(2) == colon || !starts_argument(1))) return std::nullopt;
  return found->kind;
}

ast::ExprPtr Parser::chain(ast::ChainKind kind) {
  auto const& words = words_of(kind);
  auto const head = advance().span;
  auto const partner = token().partner;
  bool const as_method = (at(left_paren) || at(left_brace)) && partner != Token::unclosed &&
                         tokens_[partner + 1].kind == dot && partner + 2 < tokens_.size() &&
                         text(tokens_[partner + 2]) == words.word;
  auto subject = as_method ? primary() : chain_subject(kind);
  if (as_method) advance();
  if (!chain_word(kind)) {
    error(code("incomplete-chain"), head, fmt::format("{} needs {}", words.head, words.word),
          fmt::format("write {}", words.pattern));
    return broken();
  }
  ast::ExprPtr body;
  if (as_method && at(left_paren)) {
    body = in_parentheses();
  } else {
    body = chain_body(kind);
  }
  return make(ast::Chain{kind, std::move(subject), std::move(body), head}, since(head.begin));
}

/// `otherwise task`, the last branch of a choice.
bool Parser::at_otherwise() const {
  if (!at_word("otherwise") || !on_same_line(1)) return false;
  return kind(1) == left_brace || kind(1) == left_paren || at_word("then", 1) || starts_argument(1);
}

ast::ExprPtr Parser::otherwise() {
  auto const head = advance().span;
  if (at_word("then")) {
    error(code("incomplete-chain"), advance().span, "otherwise takes no then", "write otherwise task");
  }
  ast::Closure always;
  always.body.span = head;
  always.body.statements.push_back(make_statement(ast::ExprStmt{make(ast::BoolLiteral{true}, head)}, head.begin));
  auto subject = make(std::move(always), head);
  auto body = expression();
  return make(ast::Chain{ast::ChainKind::when, std::move(subject), std::move(body), head, true}, since(head.begin));
}

ast::ExprPtr Parser::chain_subject(ast::ChainKind kind) {
  if (kind == ast::ChainKind::during || kind == ast::ChainKind::watch) return expression();
  if (at(left_brace)) return closure();
  if (at(left_paren)) return in_parentheses();
  auto const& words = words_of(kind);
  error(code("incomplete-chain"), token().span, fmt::format("{} needs a closure", words.head),
        fmt::format("write {}", words.pattern));
  return expression();
}

/// `then`, `run` or `onError`, also at the beginning of the next line (REC-7d). `waitFor ... run` is an old spelling.
bool Parser::chain_word(ast::ChainKind kind) {
  auto const& words = words_of(kind);
  if (at_word(words.word)) {
    advance();
    return true;
  }
  bool const is_other = at_word("then") || at_word("run") || at_word("onError");
  if (!is_other) return false;
  auto const& found = advance();
  if (kind == ast::ChainKind::wait_for && text(found) == "run") {
    diagnostics_.report(code("legacy-spelling"), found.span, "waitFor takes 'then'",
                        {fmt::format("write {}", words.pattern), {{found.span, std::string(words.word)}}});
  } else {
    error(code("incomplete-chain"), found.span,
          fmt::format("{} takes '{}', not '{}'", words.head, words.word, text(found)),
          {fmt::format("write {}", words.pattern), {{found.span, std::string(words.word)}}});
  }
  return true;
}

ast::ExprPtr Parser::chain_body(ast::ChainKind kind) {
  if (kind != ast::ChainKind::watch) return expression();
  if (at(left_brace)) return closure();
  if (at(left_paren)) return in_parentheses();
  error(code("incomplete-chain"), here(), "onError needs a closure", fmt::format("write {}", words_of(kind).pattern));
  return broken();
}

}  // namespace lapwing::dolphin
