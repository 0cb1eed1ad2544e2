#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/text/spelling.hpp"
#include "dolphin/check/internal/checker_class.hpp"
#include "dolphin/names/declared_type.hpp"
#include "dolphin/names/foreign_words.hpp"
#include "dolphin/syntax/ast_walk.hpp"

/// What the checker knows of statements that do nothing, of types that are declared and caught, and of signals.
namespace lapwing::dolphin {

namespace {

/// Exceptions of Java that the language has no name for, so that old scripts may catch them.
constexpr auto java_exceptions = std::to_array<std::string_view>({
    "ArrayIndexOutOfBoundsException",
    "CancellationException",
    "ConcurrentModificationException",
    "ConnectException",
    "ExecutionException",
    "FileNotFoundException",
    "GroovyCastException",
    "GroovyRuntimeException",
    "InterruptedException",
    "NegativeArraySizeException",
    "PowerAssertionError",
    "SecurityException",
    "StringIndexOutOfBoundsException",
    "UnsupportedOperationException",
    "VirtualMachineError",
});

bool is_one_of(auto const& names, std::string_view name) {
  return std::ranges::find(names, name) != std::ranges::end(names);
}

std::vector<std::string_view> names_of_types() {
  std::vector<std::string_view> out;
  for (auto const& one : types()) out.push_back(one.name);
  return out;
}

bool is_exception(std::string_view type) {
  return type.ends_with("Exception") || type.ends_with("Error") || type == "Throwable" || type == "Object";
}

void collect_made(ast::Expr const& expr, std::unordered_set<std::string>& out);
void collect_made(ast::Stmt const& statement, std::unordered_set<std::string>& out) {
  ast::for_each_child(statement.node, [&](auto const& child) { collect_made(child, out); });
}
/// The types behind every `new`.
void collect_made(ast::Expr const& expr, std::unordered_set<std::string>& out) {
  if (auto const* made = std::get_if<ast::New>(&expr.node)) out.insert(made->type.text);
  ast::for_each_child(expr.node, [&](auto const& child) { collect_made(child, out); });
}

/// Working it out does nothing else.
bool is_useless(ast::Expr const& expr) {
  if (auto const* binary = std::get_if<ast::Binary>(&expr.node)) {
    bool const may_skip = binary->op == ast::BinaryOp::logical_and || binary->op == ast::BinaryOp::logical_or ||
                          binary->op == ast::BinaryOp::elvis;  // `ready || start()`
    return binary->op != ast::BinaryOp::shift_left && !may_skip;
  }
  return std::holds_alternative<ast::Unary>(expr.node) || std::holds_alternative<ast::Name>(expr.node) ||
         std::holds_alternative<ast::Member>(expr.node) || std::holds_alternative<ast::IntegerLiteral>(expr.node) ||
         std::holds_alternative<ast::DecimalLiteral>(expr.node) ||
         std::holds_alternative<ast::BoolLiteral>(expr.node) || std::holds_alternative<ast::StringLiteral>(expr.node) ||
         std::holds_alternative<ast::GString>(expr.node) || std::holds_alternative<ast::ListLiteral>(expr.node) ||
         std::holds_alternative<ast::MapLiteral>(expr.node) || std::holds_alternative<ast::PatternLiteral>(expr.node);
}

/// What tells two cases apart as far as the text shows; empty for what only the run knows.
std::string label_of(ast::Expr const& expr) {
  if (auto const* whole = std::get_if<ast::IntegerLiteral>(&expr.node)) return fmt::format("{}", whole->value);
  if (auto const* truth = std::get_if<ast::BoolLiteral>(&expr.node)) return truth->value ? "true" : "false";
  if (auto const* text = std::get_if<ast::StringLiteral>(&expr.node)) return fmt::format("'{}'", text->value);
  return {};
}

}  // namespace

// ---- values that nobody uses --------------------------------------------------------------------

/// `x = 3` and `+ 4` in the next line; `list.clear`; `x == 3`.
void Checker::unused_value(ast::Expr const& expr) {
  if (!program_.unread.empty() || !is_useless(expr)) return;
  auto const& source = diagnostics_.source();
  std::string hint;
  auto const* sign = std::get_if<ast::Unary>(&expr.node);
  auto const* binary = std::get_if<ast::Binary>(&expr.node);
  auto const* member = std::get_if<ast::Member>(&expr.node);
  if (sign && sign->op != ast::UnaryOp::logical_not) {
    hint = "a sum goes on in the next line when the line before ends with its + or -";
  } else if (binary && binary->op == ast::BinaryOp::equal) {
    hint = fmt::format("to change the value write {} = ...", source.text(binary->left->span));
  } else if (member) {
    hint = fmt::format("to call it write {}()", source.text(expr.span));
  }
  diagnostics_.report(code("unused-value"), expr.span, "nothing uses this value", std::move(hint));
}

void Checker::duplicate_cases(ast::Switch const& n) {
  std::vector<std::pair<std::string, base::Span>> seen;
  for (auto const& one : n.cases) {
    auto label = one.value ? label_of(*one.value) : std::string();
    if (label.empty()) continue;
    auto const earlier = std::ranges::find(seen, label, &std::pair<std::string, base::Span>::first);
    if (earlier != seen.end()) {
      diagnostics_.report(code("duplicate-case"), one.value->span, fmt::format("case {} stands here twice", label),
                          "the first one is taken", {{earlier->second, "it stands here already"}});
    } else if (seen.size() < 200) {
      seen.emplace_back(std::move(label), one.value->span);
    }
  }
}

// ---- types --------------------------------------------------------------------------------------

/// Exceptions of Java, and those that the script itself makes, may be caught by their name.
void Checker::type_name(ast::Identifier const& type) {
  auto const known = names_of_types();
  if (is_one_of(known, type.text) || is_checked_type(type.text) || is_one_of(java_exceptions, type.text)) return;
  if (!made_types_) {
    made_types_.emplace();
    for (auto const& statement : program_.body.statements) collect_made(*statement, *made_types_);
  }
  if (is_exception(type.text) && made_types_->contains(type.text)) return;
  if (!program_.unread.empty() && may_be_defined_in_unread(type.text)) return;
  diagnostics_.report(code("unknown-type"), type.span, fmt::format("there is no type {}", type.text),
                      base::did_you_mean(type.span, type.text, known));
}

void Checker::caught_type(ast::Identifier const& type) {
  if (is_exception(type.text)) return type_name(type);
  auto const known = names_of_types();
  if (!is_one_of(known, type.text)) return type_name(type);
  diagnostics_.report(code("unknown-type"), type.span,
                      fmt::format("{} is no exception, so this catches nothing", type.text),
                      "catch (Exception e) catches all");
}

/// `int n = 'abc'`
void Checker::declared_value(ast::Identifier const& name, std::string_view type, ast::Expr const& value) {
  auto const kinds = inference_.facts(value).kinds;
  if (kinds.is_none() || kinds.meets(kinds_taken(type, Holder::variable))) return;
  diagnostics_.report(code("declared-type"), value.span,
                      fmt::format("{} is declared as {}, this is {}", name.text, type, describe(kinds)));
}

/// A declared type that is nearly one is a slip; others are classes of Java, which hold anything.
void Checker::declared_type(ast::Identifier const& type) {
  auto const known = names_of_types();
  if (is_checked_type(type.text) || is_one_of(known, type.text)) return;
  auto hint = base::did_you_mean(type.span, type.text, known);
  if (hint.empty()) return;
  diagnostics_.report(code("unknown-type"), type.span, fmt::format("there is no type {}", type.text), std::move(hint));
}

/// The arguments of `def f(int n)`.
void Checker::declared_arguments(ast::Call const& call, ast::FunctionDecl const& function) {
  for (std::size_t i = 0; i < call.arguments.size() && i < function.parameters.size(); ++i) {
    auto const& parameter = function.parameters[i];
    if (call.arguments[i].name) return;  // named ones are one map
    if (!parameter.type) continue;
    auto const& value = *call.arguments[i].value;
    auto const kinds = inference_.facts(value).kinds;
    if (kinds.is_none() || kinds.meets(kinds_taken(parameter.type->text, Holder::parameter))) continue;
    diagnostics_.report(code("declared-type"), value.span,
                        fmt::format("{} of {} is declared as {}, this is {}", parameter.name.text, function.name.text,
                                    parameter.type->text, describe(kinds)),
                        {}, {{parameter.name.span, "it is declared here"}});
  }
}

// ---- names --------------------------------------------------------------------------------------

/// `def battery(v) { ... }`
void Checker::hidden_instructions() {
  for (auto const& [name, functions] : resolution_.functions) {
    if (!resolution_.instructions.find(name) && !find_builder(name)) continue;
    diagnostics_.report(code("hidden-instruction"), functions.front()->name.span,
                        fmt::format("this function hides the instruction {}", name), "give it a name of its own");
  }
}

// ---- signals ------------------------------------------------------------------------------------

void Checker::note_signals(ast::Call const& call, std::string_view instruction) {
  if (instruction != "post" && instruction != "consume" && instruction != "poll") return;
  for (auto const& argument : call.arguments) {
    auto const* text = argument.name ? nullptr : std::get_if<ast::StringLiteral>(&argument.value->node);
    if (instruction == "post") {
      if (argument.name) posted_.insert(argument.name->text);
      if (!argument.name) posts_unknown_ = true;  // a map that only the run knows
    } else if (argument.name) {
      awaited_.push_back({argument.name->text, argument.name->span, instruction == "consume"});
    } else if (text && instruction == "poll") {
      awaited_.push_back({text->value, argument.value->span, false});
    }
  }
}

/// `consume raedy: 1`: nobody posts that. A poll may be meant to be false; it is told only when a name is near.
void Checker::unposted_signals() {
  if (posts_unknown_ || !program_.unread.empty()) return;
  std::vector<std::string_view> const known(posted_.begin(), posted_.end());
  std::unordered_set<std::string_view> told;
  for (auto const& one : awaited_) {
    if (posted_.contains(one.name)) continue;
    bool const is_word = one.span.size() == one.name.size();
    auto hint =
        is_word ? base::did_you_mean(one.span, one.name, known) : base::Hint(base::did_you_mean(one.name, known));
    if ((!one.is_taken && hint.empty()) || !told.insert(one.name).second) continue;
    diagnostics_.report(code("unposted-signal"), one.span, fmt::format("nothing posts the signal {}", one.name),
                        std::move(hint));
  }
}

}  // namespace lapwing::dolphin
