#include "dolphin/check/flow/internal/flow_changes.hpp"

#include "dolphin/check/internal/task_shape.hpp"
#include "dolphin/syntax/ast_walk.hpp"

namespace lapwing::dolphin {

namespace {

std::vector<Variable const*> assigned_by(ast::Stmt const& statement, Resolution const& resolution) {
  std::vector<Variable const*> out;
  auto const* assign = std::get_if<ast::Assign>(&statement.node);
  auto const add = [&](ast::Expr const& target) {
    if (!std::holds_alternative<ast::Name>(target.node)) return;
    if (auto const* variable = resolution.find(target)) out.push_back(variable);
  };
  if (assign) add(*assign->target);
  for (std::size_t i = 0; assign && i < assign->more.size(); ++i) add(*assign->more[i]);
  return out;
}

/// Finds assignments and picks in closures and functions.
class DeferredFinder {
 public:
  explicit DeferredFinder(Resolution const& resolution) : resolution_(resolution) {}

  void visit(ast::Stmt const& statement) {
    auto const* function = std::get_if<ast::FunctionDecl>(&statement.node);
    for (auto const* variable : assigned_by(statement, resolution_)) {
      bool const is_foreign = variable->kind == VariableKind::global && in_function_;
      if (closures_ > 0 || is_foreign) out.assigned.insert(variable);
    }
    if (auto const* declared = std::get_if<ast::VarDecl>(&statement.node); declared && closures_ > 0) {
      for (auto const& name : declared->names) out.assigned.insert(resolution_.find(name));
    }
    if (function) in_function_ = true;
    ast::for_each_child(statement.node, [this](auto const& child) { visit(child); });
    if (function) in_function_ = false;
  }

  void visit(ast::Expr const& expr) {
    auto const* call = std::get_if<ast::Call>(&expr.node);
    bool const is_deferred = closures_ > 0 || in_function_;
    if (call && is_deferred && called_instruction(*call, resolution_) == "pick") out.picks = true;
    bool const is_closure = std::holds_alternative<ast::Closure>(expr.node);
    closures_ += is_closure ? 1 : 0;
    ast::for_each_child(expr.node, [this](auto const& child) { visit(child); });
    closures_ -= is_closure ? 1 : 0;
  }

  DeferredChanges out;

 private:
  Resolution const& resolution_;
  int closures_ = 0;
  bool in_function_ = false;
};

void add_names(ast::Expr const& expr, base::Span place, FlowChanges& out) {
  if (std::holds_alternative<ast::Name>(expr.node)) out.released.emplace_back(&expr, place);
  if (std::holds_alternative<ast::Call>(expr.node) || std::holds_alternative<ast::Closure>(expr.node)) return;
  ast::for_each_child(expr.node, [&](auto const& child) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, ast::Expr>) add_names(child, place, out);
  });
}

}  // namespace

void FlowChanges::add(ast::Block const& block, Resolution const& resolution) {
  for (auto const& statement : block.statements) add(*statement, resolution);
}

void FlowChanges::add(ast::Stmt const& statement, Resolution const& resolution) {
  if (std::holds_alternative<ast::FunctionDecl>(statement.node)) return;
  for (auto const* variable : assigned_by(statement, resolution)) assigned.insert(variable);
  if (auto const* declared = std::get_if<ast::VarDecl>(&statement.node)) {
    for (auto const& name : declared->names) assigned.insert(resolution.find(name));
  }
  if (auto const* loop = std::get_if<ast::ForIn>(&statement.node)) assigned.insert(resolution.find(loop->variable));
  ast::for_each_child(statement.node, [&](auto const& child) { add(child, resolution); });
}

void FlowChanges::add(ast::Expr const& expr, Resolution const& resolution) {
  if (std::holds_alternative<ast::Closure>(expr.node)) return;
  if (auto const* call = std::get_if<ast::Call>(&expr.node)) {
    auto const name = called_instruction(*call, resolution);
    if (name == "pick") picks = true;
    if (name.empty() || name == "execute") calls = true;
    if (name == "release") {
      for (auto const& argument : call->arguments) add_names(*argument.value, expr.span, *this);
    }
  }
  ast::for_each_child(expr.node, [&](auto const& child) { add(child, resolution); });
}

DeferredChanges deferred_changes(ast::Program const& program, Resolution const& resolution) {
  DeferredFinder finder(resolution);
  for (auto const& statement : program.body.statements) finder.visit(*statement);
  return std::move(finder.out);
}

}  // namespace lapwing::dolphin
