#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>

#include "dolphin/check/fixes.hpp"
#include "dolphin/check/internal/checker_class.hpp"
#include "dolphin/names/foreign_words.hpp"
#include "dolphin/names/vehicle_types.hpp"
#include "dolphin/syntax/ast_walk.hpp"

/// What the checker knows of tasks and of the numbers that instructions refuse.
namespace lapwing::dolphin {

namespace {

/// Calls `visit` with every expression below and including this one, closures included.
template <class Visit>
void for_each_expr(ast::Expr const& expr, Visit& visit);

template <class Visit>
void for_each_expr(ast::Stmt const& statement, Visit& visit) {
  ast::for_each_child(statement.node, [&](auto const& child) { for_each_expr(child, visit); });
}
template <class Visit>
void for_each_expr(ast::Expr const& expr, Visit& visit) {
  visit(expr);
  ast::for_each_child(expr.node, [&](auto const& child) { for_each_expr(child, visit); });
}

bool is_when(ast::Expr const& expr) {
  if (auto const* chain = std::get_if<ast::Chain>(&expr.node)) return chain->kind == ast::ChainKind::when;
  return std::holds_alternative<ast::ErrorExpr>(expr.node);
}

std::optional<double> number(std::optional<tasks::Argument> const& value) {
  if (!value) return std::nullopt;
  if (auto const* whole = std::get_if<std::int64_t>(&*value)) return static_cast<double>(*whole);
  if (auto const* decimal = std::get_if<double>(&*value)) return *decimal;
  return std::nullopt;
}

}  // namespace

/// `oneOf { }`. A function that the block calls may add branches.
void Checker::empty_choice(ast::Call const& call, InstructionSpec const& spec) {
  auto const& argument = *call.arguments.front().value;
  if (!std::holds_alternative<ast::Closure>(argument.node)) return;
  bool may_have_branches = false;
  auto look = [&](ast::Expr const& expr) {
    auto const* made = std::get_if<ast::Call>(&expr.node);
    may_have_branches = may_have_branches || is_when(expr) || (made && called_instruction(*made, resolution_).empty());
  };
  for_each_expr(argument, look);
  if (may_have_branches) return;
  diagnostics_.report(code("no-branches"), call.callee->span, fmt::format("{} has no branches, so it halts", spec.name),
                      "add when { condition } then task");
}

void Checker::consuming_guard(ast::Expr const& guard) {
  ast::Expr const* found = nullptr;
  auto look = [&](ast::Expr const& expr) {
    auto const* made = std::get_if<ast::Call>(&expr.node);
    if (!found && made && called_instruction(*made, resolution_) == "consume") found = made->callee.get();
  };
  for_each_expr(guard, look);
  if (!found) return;
  diagnostics_.report(code("consume-in-guard"), found->span,
                      "this takes the signal, which is lost when the task round it is stopped",
                      "poll here, and consume in an action when the task is done");
}

// ---- vehicles -----------------------------------------------------------------------------------

/// `battery(v)` with v = pick { count 2 }.
void Checker::single_vehicle(ast::Call const& call, InstructionSpec const& spec) {
  bool const needs_one = spec.name == "battery" || spec.name == "position" || spec.name == "connected";
  if (!needs_one || call.arguments.size() != 1) return;
  auto const& set = *call.arguments[0].value;
  auto const count = least_vehicles(set, 8);
  if (count < 2) return;
  diagnostics_.report(code("several-vehicles"), set.span,
                      fmt::format("{} takes a single vehicle, this set has {}", spec.name, count),
                      "of each: set.collect { " + std::string(spec.name) + "(it) }");
}

/// The set has at least so many, however the script runs.
std::size_t Checker::least_vehicles(ast::Expr const& set, int depth) {
  if (depth <= 0) return 0;
  if (std::holds_alternative<ast::Name>(set.node)) {
    auto const* value = only_value(resolution_.find(set));
    return value ? least_vehicles(*value, depth - 1) : 0;
  }
  if (auto const* binary = std::get_if<ast::Binary>(&set.node); binary && binary->op == ast::BinaryOp::add) {
    return std::max(least_vehicles(*binary->left, depth - 1), least_vehicles(*binary->right, depth - 1));
  }
  auto const* call = std::get_if<ast::Call>(&set.node);
  if (!call || called_instruction(*call, resolution_) != "pick" || call->arguments.size() != 1) return 0;
  auto const* body = std::get_if<ast::Closure>(&call->arguments[0].value->node);
  if (!body) return 0;
  std::size_t count = 1;
  for (auto const& statement : body->body.statements) {
    auto const* expr = std::get_if<ast::ExprStmt>(&statement->node);
    auto const* field = expr ? std::get_if<ast::Call>(&expr->expr->node) : nullptr;
    auto const* name = field ? std::get_if<ast::Name>(&field->callee->node) : nullptr;
    if (!name) return 0;  // other code may set the count
    if (name->text != "count" || field->arguments.size() != 1) continue;
    auto const wanted = number(inference_.constant(*field->arguments[0].value));
    count = wanted && *wanted >= 1.0 && *wanted < 1e6 ? static_cast<std::size_t>(*wanted) : 0;
  }
  return count;
}

// ---- numbers ------------------------------------------------------------------------------------

void Checker::value(ast::Expr const& expr, base::DiagnosticKind const& kind, double least, double most,
                    std::string_view what) {
  auto const known = number(inference_.constant(expr));
  if (!known || (*known >= least && *known <= most)) return;
  auto const wanted = most < 1e9 ? fmt::format("lies between {} and {}", least, most)
                                 : fmt::format("must {} {}", least > 0 ? "be at least" : "not be less than", least);
  diagnostics_.report(kind, expr.span, fmt::format("{} {}, this is {}", what, wanted, *known));
}

/// Types are compared letter by letter: `pick { type 'uav' }` would wait for a vehicle that never comes.
void Checker::vehicle_type(ast::Call const& call) {
  if (call.arguments.empty()) return;
  auto const& wanted = *call.arguments.front().value;
  auto const constant = inference_.constant(wanted);
  auto const* type = constant ? std::get_if<std::string>(&*constant) : nullptr;
  if (!type || std::ranges::find(vehicle_types, *type) != vehicle_types.end()) return;
  auto const meant = vehicle_type_meant(*type);
  auto hint = meant.empty()
                  ? did_you_mean_in_quotes(diagnostics_.source(), wanted, *type, vehicle_types)
                  : base::Hint(fmt::format("write type '{}'; the types are {}", meant, fmt::join(vehicle_types, ", ")),
                               {{wanted.span, fmt::format("'{}'", meant)}});
  if (hint.empty()) return;
  diagnostics_.report(code("misspelt-type"), wanted.span, fmt::format("no vehicle is of type {}", *type),
                      std::move(hint));
}

/// Numbers that the instruction refuses at run time.
void Checker::values(ast::Call const& call, InstructionSpec const& spec) {
  auto const check = [&](std::size_t position, base::DiagnosticKind const& kind, double least, double most,
                         std::string_view what) {
    if (position < call.arguments.size() && !call.arguments[position].name)
      value(*call.arguments[position].value, kind, least, most, what);
  };
  constexpr double any = 1e12;
  bool const in_pick = !contexts_.empty() && contexts_.back().kind == BlockKind::pick;
  if (in_pick && spec.name == "count") check(0, code("halting-value"), 1.0, any, "the count of pick");
  if (in_pick && spec.name == "timeout") check(0, code("halting-value"), 0.0, any, "the timeout of pick");
  if (in_pick && spec.name == "type") vehicle_type(call);
  if (spec.name == "idle" || spec.name == "pause") check(0, code("argument-value"), 0.0, any, "this time");
  if (spec.name == "area") check(1, code("argument-value"), 0.0, any, "the radius");
  if (spec.name != "location") return;
  check(0, code("argument-value"), -90.0, 90.0, "the latitude");
  check(1, code("argument-value"), -180.0, 360.0, "the longitude");
}

// ---- tasks that never run -----------------------------------------------------------------------

void Checker::endless_sequence(ast::Binary const& binary) {
  if (binary.op != ast::BinaryOp::shift_right || !tasks_.of(*binary.left).never_ends) return;
  diagnostics_.report(code("unreachable-code"), binary.right->span,
                      "this is never reached: what stands before >> never ends", "end it: task / { condition }");
}

/// A mission behind a landing that needs none before it.
void Checker::landed(ast::Expr const& before, ast::Expr const& after) {
  auto const* last = tasks_.ending(before);
  auto const* next = tasks_.beginning(after);
  auto const ended = last ? tasks_.built(*last) : nullptr;
  auto const begun = next ? tasks_.built(*next) : nullptr;
  if (!ended || !begun) return;
  if (auto const doubt = begun->cannot_follow(*ended))
    diagnostics_.report(code("implausible-mission"), after.span, doubt->what, doubt->hint);
}

/// `a >> b`
void Checker::landed_sequence(ast::Binary const& binary) {
  if (binary.op == ast::BinaryOp::shift_right) landed(*binary.left, *binary.right);
}

/// `execute v: a` and, with nothing but missions and messages between, `execute v: b`
void Checker::landed_executes(ast::Block const& block) {
  ast::Argument const* before = nullptr;
  for (auto const& statement : block.statements) {
    if (auto const* argument = execution_on_one(*statement)) {
      if (before && before->name->text == argument->name->text) landed(*before->value, *argument->value);
      before = argument;
      continue;
    }
    auto const* assign = std::get_if<ast::Assign>(&statement->node);
    auto const* expr = std::get_if<ast::ExprStmt>(&statement->node);
    auto const* call = expr ? std::get_if<ast::Call>(&expr->expr->node) : nullptr;
    bool const makes_mission = assign && assign->value && !tasks_.blocks(*assign->value).empty();
    bool const only_says = call && called_instruction(*call, resolution_) == "message";
    if (!makes_mission && !only_says) before = nullptr;
  }
}

/// The task of an `execute` for a single vehicle that a variable holds; null for anything else.
ast::Argument const* Checker::execution_on_one(ast::Stmt const& statement) {
  auto const* expr = std::get_if<ast::ExprStmt>(&statement.node);
  auto const* call = expr ? std::get_if<ast::Call>(&expr->expr->node) : nullptr;
  if (!call || called_instruction(*call, resolution_) != "execute" || call->arguments.size() != 1) return nullptr;
  auto const& argument = call->arguments.front();
  auto const* value = argument.name ? only_value(resolution_.find(*argument.name)) : nullptr;
  return value && least_vehicles(*value, 8) == 1 ? &argument : nullptr;
}

/// Variables that hold tasks and that nothing reads. Says nothing where a misspelt name may have been meant for one,
/// nor of missions that may be executed by their name.
void Checker::unused_tasks() {
  if (!program_.unread.empty() || !reported_.empty()) return;
  auto const may_have_name = [&](ast::Expr const* value) { return !tasks_.blocks(*value).empty(); };
  for (auto const& variable : resolution_.variables) {
    bool const is_task = inference_.facts(variable).kinds == Kinds(Kind::task);
    if (!is_task || read_.contains(&variable)) continue;
    if (names_plans_ && std::ranges::any_of(variable.values, may_have_name)) continue;
    diagnostics_.report(code("never-executed"), variable.defined, fmt::format("{} is never executed", variable.name),
                        fmt::format("write execute {}", variable.name));
  }
}

}  // namespace lapwing::dolphin
