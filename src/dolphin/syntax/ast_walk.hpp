#pragma once

#include <type_traits>
#include <variant>

#include "dolphin/syntax/ast.hpp"

/// Passes over a syntax tree without knowing every node.
namespace lapwing::dolphin::ast {

namespace walk_detail {

template <class Visit>
void each(ExprPtr const& child, Visit&& visit) {
  if (child) visit(*child);
}
template <class Visit>
void each(StmtPtr const& child, Visit&& visit) {
  if (child) visit(*child);
}
template <class Visit>
void each(Block const& block, Visit&& visit) {
  for (auto const& statement : block.statements) each(statement, visit);
}
template <class Visit>
void each(std::vector<ExprPtr> const& children, Visit&& visit) {
  for (auto const& child : children) each(child, visit);
}
template <class Visit>
void each(std::vector<Argument> const& arguments, Visit&& visit) {
  for (auto const& argument : arguments) each(argument.value, visit);
}
template <class Visit>
void each(std::vector<Parameter> const& parameters, Visit&& visit) {
  for (auto const& parameter : parameters) each(parameter.fallback, visit);
}

template <class Visit>
struct ExprChildren {
  Visit& visit;

  void operator()(GString const& n) const {
    for (auto const& piece : n.pieces) {
      if (auto const* expr = std::get_if<ExprPtr>(&piece)) each(*expr, visit);
    }
  }
  void operator()(ListLiteral const& n) const {
    for (auto const& item : n.items) each(item, visit);
  }
  void operator()(MapLiteral const& n) const {
    for (auto const& entry : n.entries) all(entry.key, entry.value);
  }
  void operator()(Range const& n) const { all(n.first, n.last); }
  void operator()(Unary const& n) const { all(n.operand); }
  void operator()(Step const& n) const { all(n.target); }
  void operator()(Binary const& n) const { all(n.left, n.right); }
  void operator()(Cast const& n) const { all(n.operand); }
  void operator()(InstanceOf const& n) const { all(n.operand); }
  void operator()(Ternary const& n) const { all(n.condition, n.if_true, n.if_false); }
  void operator()(Member const& n) const { all(n.object); }
  void operator()(Index const& n) const { all(n.object, n.index); }
  void operator()(Call const& n) const { all(n.callee, n.arguments); }
  void operator()(New const& n) const { all(n.arguments); }
  void operator()(Closure const& n) const { all(n.parameters, n.body); }
  void operator()(Chain const& n) const { all(n.subject, n.body); }
  template <class Leaf>
  void operator()(Leaf const&) const {
    static_assert(std::is_empty_v<Leaf> || std::is_same_v<Leaf, BoolLiteral> || std::is_same_v<Leaf, IntegerLiteral> ||
                  std::is_same_v<Leaf, DecimalLiteral> || std::is_same_v<Leaf, StringLiteral> ||
                  std::is_same_v<Leaf, PatternLiteral> || std::is_same_v<Leaf, Name>);
  }

  template <class... Children>
  void all(Children const&... children) const {
    (each(children, visit), ...);
  }
};

template <class Visit>
struct StmtChildren {
  Visit& visit;

  void operator()(ExprStmt const& n) const { all(n.expr); }
  void operator()(Assign const& n) const { all(n.target, n.more, n.value); }
  void operator()(VarDecl const& n) const { all(n.value); }
  void operator()(FunctionDecl const& n) const { all(n.parameters, n.body); }
  void operator()(If const& n) const {
    all(n.condition, n.then);
    if (n.otherwise) all(*n.otherwise);
  }
  void operator()(While const& n) const {
    if (n.body_first) return all(n.body, n.condition);
    all(n.condition, n.body);
  }
  void operator()(For const& n) const { all(n.init, n.condition, n.update, n.body); }
  void operator()(ForIn const& n) const { all(n.iterable, n.body); }
  void operator()(Switch const& n) const {
    all(n.subject);
    for (auto const& one : n.cases) all(one.value, one.body);
  }
  void operator()(Try const& n) const {
    all(n.body);
    for (auto const& one : n.catches) all(one.body);
    if (n.finally) all(*n.finally);
  }
  void operator()(Throw const& n) const { all(n.value); }
  void operator()(Return const& n) const { all(n.value); }
  void operator()(Assert const& n) const { all(n.condition, n.message); }
  void operator()(Break const&) const {}
  void operator()(Continue const&) const {}
  void operator()(Import const&) const {}

  template <class... Children>
  void all(Children const&... children) const {
    (each(children, visit), ...);
  }
};

}  // namespace walk_detail

/// Calls `visit` with each Expr and Stmt directly below the node, in the order of the text (of Chain: subject first).
template <class Visit>
void for_each_child(Expr::Node const& node, Visit&& visit) {
  std::visit(walk_detail::ExprChildren<std::remove_reference_t<Visit>>{visit}, node);
}
template <class Visit>
void for_each_child(Stmt::Node const& node, Visit&& visit) {
  std::visit(walk_detail::StmtChildren<std::remove_reference_t<Visit>>{visit}, node);
}

}  // namespace lapwing::dolphin::ast
