#include "dolphin/check/checker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dolphin/check/fixes.hpp"
#include "dolphin/check/flow/vehicle_flow.hpp"
#include "dolphin/check/internal/checker_class.hpp"
#include "dolphin/check/internal/loop_shape.hpp"
#include "dolphin/syntax/ast_walk.hpp"
#include "dolphin/syntax/characters.hpp"

namespace lapwing::dolphin {

namespace {

void add_words(std::string_view text, std::unordered_set<std::string>& words) {
  while (!text.empty()) {
    std::size_t size = 0;
    while (auto const more = identifier_character(text.substr(size))) size += more;
    if (size > 0) words.emplace(text.substr(0, size));
    text.remove_prefix(std::max<std::size_t>(size, 1));
  }
}

/// No way leads to its end. Looks at its last statement only.
bool ends_early(ast::Block const& block) {
  if (block.statements.empty()) return false;
  auto const& last = block.statements.back()->node;
  if (auto const* branch = std::get_if<ast::If>(&last)) {
    return branch->otherwise && ends_early(branch->then) && ends_early(*branch->otherwise);
  }
  return std::holds_alternative<ast::Return>(last) || std::holds_alternative<ast::Break>(last) ||
         std::holds_alternative<ast::Continue>(last) || std::holds_alternative<ast::Throw>(last);
}

}  // namespace

void check(ast::Program const& program, tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics) {
  Checker(program, vocabulary, diagnostics).run();
}

Checker::Checker(ast::Program const& program, tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics)
    : program_(program),
      diagnostics_(diagnostics),
      resolution_(resolve(program, InstructionTable(vocabulary.instructions))),
      inference_(resolution_, vocabulary.builders),
      tasks_(resolution_, inference_, vocabulary.builders) {
  for (auto const& spec : vocabulary.builders) {
    Builder made{&spec, {}};
    for (auto const& command : spec.commands) made.words.push_back(instruction_of(command));
    builders_.push_back(std::move(made));
  }
  for (auto const& variable : resolution_.variables) {
    if (variable.kind == VariableKind::local) locals_.insert(variable.name);
  }
  for (auto const span : program.unread) add_words(diagnostics.source().text(span), unread_names_);
}

void Checker::run() {
  function_overloads();
  hidden_instructions();
  for (auto const* name : resolution_.redeclared) {
    diagnostics_.report(code("redeclared-variable"), name->span, fmt::format("{} is already declared here", name->text),
                        "write it without def to change its value");
  }
  block(program_.body, false);
  // What could not be read may have picked or released any vehicle.
  if (program_.unread.empty()) check_vehicle_flow(program_, resolution_, inference_, tasks_, diagnostics_);
  unused_tasks();
  unposted_signals();
}

/// Functions of one name differ in the number of their parameters.
void Checker::function_overloads() {
  for (auto const& [name, functions] : resolution_.functions) {
    for (std::size_t i = 1; i < functions.size() && i < 20; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (functions[i]->parameters.size() != functions[j]->parameters.size()) continue;
        diagnostics_.report(code("duplicate-function"), functions[i]->name.span,
                            fmt::format("the function {} is already defined", name), {},
                            {{functions[j]->name.span, "it is defined here"}});
        break;
      }
    }
  }
}

// ---- statements ---------------------------------------------------------------------------------

/// Why nothing comes after this statement: "return", or empty.
std::string_view Checker::ends_with(ast::Stmt const& statement) {
  if (std::holds_alternative<ast::Return>(statement.node)) return "return";
  if (std::holds_alternative<ast::Break>(statement.node)) return "break";
  if (std::holds_alternative<ast::Continue>(statement.node)) return "continue";
  if (std::holds_alternative<ast::Throw>(statement.node)) return "throw";
  if (never_ends(statement)) return "a loop without a break";
  if (auto const* branch = std::get_if<ast::If>(&statement.node)) {
    bool const ends = branch->otherwise && ends_early(branch->then) && ends_early(*branch->otherwise);
    return ends ? "an if of which no branch goes on" : "";
  }
  auto const* expr = std::get_if<ast::ExprStmt>(&statement.node);
  auto const* call = expr ? std::get_if<ast::Call>(&expr->expr->node) : nullptr;
  return call ? ends_with(*call) : "";
}

std::string_view Checker::ends_with(ast::Call const& call) {
  auto const instruction = called_instruction(call, resolution_);
  if (instruction == "halt") return "halt";
  if (instruction != "execute" || block_word("execute")) return "";
  bool const never_ends = std::ranges::any_of(
      call.arguments, [this](ast::Argument const& argument) { return tasks_.of(*argument.value).never_ends; });
  return never_ends ? "a task that never ends" : "";
}

void Checker::block(ast::Block const& block, bool is_value) {
  bool const is_script = &block == &program_.body;
  // `case 1: 'one'; break` has the value that stands before the break.
  bool const breaks = block.statements.size() > 1 && std::holds_alternative<ast::Break>(block.statements.back()->node);
  auto const last = block.statements.size() - (breaks ? 1 : 0);
  std::string_view end;
  for (std::size_t i = 0; i < block.statements.size(); ++i) {
    auto const& one = *block.statements[i];
    if (is_script) top_statement_ = i;
    if (!end.empty() && !std::holds_alternative<ast::FunctionDecl>(one.node)) {
      diagnostics_.report(code("unreachable-code"), one.span,
                          fmt::format("this is never reached: it stands behind {}", end));
      end = {};
    }
    statement(one, is_value && i + 1 == last);
    if (auto const why = ends_with(one); !why.empty()) end = why;
  }
  landed_executes(block);
}

void Checker::statement(ast::Stmt const& statement, bool is_value) {
  std::visit([&](auto const& node) { check(node, statement, is_value); }, statement.node);
}

void Checker::check(ast::ExprStmt const& n, ast::Stmt const& statement, bool is_value) {
  auto const before = diagnostics_.error_count();
  expression(n.expr);
  if (is_value || diagnostics_.error_count() > before) return;
  auto const kinds = inference_.facts(*n.expr).kinds;
  if (kinds == Kinds(Kind::task)) {
    diagnostics_.report(code("never-executed"), n.expr->span, "this task is never executed",
                        executed(diagnostics_.source(), statement.span));
  } else if (std::holds_alternative<ast::Closure>(n.expr->node)) {
    diagnostics_.report(code("never-called"), n.expr->span, "this closure is never called");
  } else {
    unused_value(*n.expr);
  }
}

void Checker::check(ast::Assign const& n, ast::Stmt const&, bool) {
  bool const is_name = std::holds_alternative<ast::Name>(n.target->node);
  auto const* variable = is_name ? resolution_.find(*n.target) : nullptr;
  bool const is_first = variable && variable->kind == VariableKind::global && variable->defined == n.target->span;
  auto const outer = std::exchange(defining_, is_first ? variable : defining_);
  expression(n.value);
  defining_ = outer;
  if (is_first && !n.op) assigned_field(*n.target);
  assigned(n, *n.target);
  for (auto const& target : n.more) assigned(n, *target);
}

void Checker::assigned(ast::Assign const& n, ast::Expr const& target) {
  auto const* name = std::get_if<ast::Name>(&target.node);
  bool const is_place =
      std::holds_alternative<ast::Member>(target.node) || std::holds_alternative<ast::Index>(target.node);
  if (is_place || (name && n.op)) expression(target);  // of anything else the reader has complained
  auto const* variable = name && !n.op && !n.unpacks ? resolution_.find(target) : nullptr;
  if (variable && variable->type) declared_value({name->text, target.span}, variable->type->text, *n.value);
}

/// `pick { type = 'UAV' }` picks vehicles of any type.
void Checker::assigned_field(ast::Expr const& target) {
  auto const& name = std::get<ast::Name>(target.node).text;
  if (contexts_.empty() || !block_word(name)) return;
  diagnostics_.report(code("assigned-field"), target.span,
                      fmt::format("this makes a variable; the {} of {} is not set", name, contexts_.back().name),
                      without_equals_sign(diagnostics_.source(), target.span));
}

void Checker::check(ast::VarDecl const& n, ast::Stmt const&, bool) {
  expression(n.value);
  if (n.type) declared_type(*n.type);
  if (n.type && n.value && !n.unpacks) declared_value(n.names.front(), n.type->text, *n.value);
}

void Checker::check(ast::FunctionDecl const& n, ast::Stmt const&, bool) {
  auto const outer = std::exchange(place_, {.in_closure = true});
  auto const contexts = std::exchange(contexts_, {});
  for (auto const& parameter : n.parameters) {
    expression(parameter.fallback);
    if (parameter.type) declared_type(*parameter.type);
  }
  block(n.body, true);
  contexts_ = contexts;
  place_ = outer;
}

void Checker::check(ast::If const& n, ast::Stmt const&, bool is_value) {
  expression(n.condition);
  block(n.then, is_value);
  if (n.otherwise) block(*n.otherwise, is_value);
}

void Checker::loop_body(ast::Block const& body) {
  auto const outer = place_;
  place_.in_loop = true;
  block(body, false);
  place_ = outer;
}

void Checker::check(ast::While const& n, ast::Stmt const& statement, bool) {
  if (n.body_first) loop_body(n.body);
  expression(n.condition);
  if (!n.body_first) loop_body(n.body);
  spinning(n.condition.get(), n.body, statement);
}

void Checker::check(ast::For const& n, ast::Stmt const& statement, bool) {
  if (n.init) this->statement(*n.init, true);
  expression(n.condition);
  if (n.update) this->statement(*n.update, true);
  loop_body(n.body);
  if (!n.update) spinning(n.condition.get(), n.body, statement);
}

void Checker::check(ast::ForIn const& n, ast::Stmt const&, bool) {
  expression(n.iterable);
  loop_body(n.body);
}

/// `while (battery(v) < 0.9) { }` keeps the machine busy, and in simulated time waits for ever.
void Checker::spinning(ast::Expr const* condition, ast::Block const& body, ast::Stmt const& statement) {
  if (diagnostics_.has_errors()) return;  // part of the loop may be unread
  // What code of running tasks tests may be changed by other tasks.
  bool const may_be_changed = place_.in_closure && condition && !never_ends(statement);
  if (may_be_changed || !spins(condition, body, resolution_)) return;
  auto const begin = statement.span.begin;
  auto const* loop = std::get_if<ast::While>(&statement.node);
  auto const word = !loop ? 3u : loop->body_first ? 2u : 5u;
  diagnostics_.report(code("endless-loop"), {begin, begin + word}, "this loop never ends, and nothing in it waits",
                      "to wait write pause 1, or execute condition { ... }");
}

void Checker::check(ast::Switch const& n, ast::Stmt const&, bool is_value) {
  expression(n.subject);
  duplicate_cases(n);
  auto const outer = place_;
  place_.in_switch = true;
  for (auto const& one : n.cases) {
    expression(one.value);
    block(one.body, is_value);
  }
  place_ = outer;
}

void Checker::check(ast::Try const& n, ast::Stmt const&, bool is_value) {
  block(n.body, is_value);
  for (auto const& one : n.catches) {
    for (auto const& type : one.types) caught_type(type);
    block(one.body, is_value);
  }
  if (n.finally) block(*n.finally, false);
}

void Checker::check(ast::Throw const& n, ast::Stmt const&, bool) {
  expression(n.value);
}
void Checker::check(ast::Return const& n, ast::Stmt const&, bool) {
  expression(n.value);
}

void Checker::check(ast::Break const&, ast::Stmt const& statement, bool) {
  if (!place_.in_loop && !place_.in_switch)
    diagnostics_.report(code("misplaced-break"), statement.span, "break stands outside a loop");
}

void Checker::check(ast::Continue const&, ast::Stmt const& statement, bool) {
  if (!place_.in_loop) diagnostics_.report(code("misplaced-break"), statement.span, "continue stands outside a loop");
}

void Checker::check(ast::Assert const& n, ast::Stmt const&, bool) {
  expression(n.condition);
  expression(n.message);
}

void Checker::check(ast::Import const&, ast::Stmt const&, bool) {}

}  // namespace lapwing::dolphin
