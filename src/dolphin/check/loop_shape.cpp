#include "dolphin/check/internal/loop_shape.hpp"

#include <algorithm>
#include <array>
#include <string_view>

#include "dolphin/check/internal/task_shape.hpp"
#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

bool is_true(ast::Expr const& condition) {
  auto const* literal = std::get_if<ast::BoolLiteral>(&condition.node);
  return literal && literal->value;
}

/// A break that ends the loop with this body.
bool has_break(ast::Block const& body) {
  return std::ranges::any_of(body.statements, [](ast::StmtPtr const& statement) {
    if (std::holds_alternative<ast::Break>(statement->node)) return true;
    bool const is_own =
        std::holds_alternative<ast::While>(statement->node) || std::holds_alternative<ast::For>(statement->node) ||
        std::holds_alternative<ast::ForIn>(statement->node) || std::holds_alternative<ast::Switch>(statement->node);
    if (is_own) return false;
    if (auto const* branch = std::get_if<ast::If>(&statement->node)) {
      return has_break(branch->then) || (branch->otherwise && has_break(*branch->otherwise));
    }
    auto const* guarded = std::get_if<ast::Try>(&statement->node);
    return guarded && (has_break(guarded->body) || std::ranges::any_of(guarded->catches, [](ast::Catch const& one) {
                         return has_break(one.body);
                       }));
  });
}

constexpr auto waiting = std::to_array<std::string_view>({"ask", "execute", "halt", "pause", "pick"});

/// What a loop may do, nested code and closures included.
struct Effects {
  Resolution const& resolution;
  bool may_wait_or_leave = false;
  bool may_change = false;

  void add(ast::Stmt const& statement) {
    bool const leaves =
        std::holds_alternative<ast::Return>(statement.node) || std::holds_alternative<ast::Throw>(statement.node) ||
        std::holds_alternative<ast::Assert>(statement.node) || std::holds_alternative<ast::Break>(statement.node);
    may_wait_or_leave = may_wait_or_leave || leaves;
    may_change = may_change || std::holds_alternative<ast::Assign>(statement.node);
    ast::for_each_child(statement.node, [this](auto const& child) { add(child); });
  }
  void add(ast::Expr const& expr) {
    may_change = may_change || std::holds_alternative<ast::Step>(expr.node);
    if (auto const* call = std::get_if<ast::Call>(&expr.node)) add_call(*call);
    ast::for_each_child(expr.node, [this](auto const& child) { add(child); });
  }
  void add_call(ast::Call const& call) {
    bool const is_method = !std::holds_alternative<ast::Name>(call.callee->node);
    auto const instruction = called_instruction(call, resolution);
    may_change = may_change || is_method || instruction == "post";
    if (is_method) return;
    bool const may_wait = instruction.empty() || std::ranges::find(waiting, instruction) != waiting.end();
    may_wait_or_leave = may_wait_or_leave || may_wait;
  }
};

}  // namespace

bool never_ends(ast::Stmt const& statement) {
  if (auto const* loop = std::get_if<ast::While>(&statement.node))
    return is_true(*loop->condition) && !has_break(loop->body);
  auto const* loop = std::get_if<ast::For>(&statement.node);
  return loop && !loop->condition && !has_break(loop->body);
}

bool spins(ast::Expr const* condition, ast::Block const& body, Resolution const& resolution) {
  Effects effects{resolution};
  if (condition) effects.add(*condition);
  for (auto const& statement : body.statements) effects.add(*statement);
  bool const is_endless = !condition || is_true(*condition);
  return !effects.may_wait_or_leave && (is_endless || !effects.may_change);
}

}  // namespace lapwing::dolphin
