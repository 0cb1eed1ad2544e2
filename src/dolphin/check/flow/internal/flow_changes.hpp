#pragma once

#include <unordered_set>
#include <utility>
#include <vector>

#include "dolphin/names/resolver.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// What code may do to vehicle sets, whatever way through it is taken. Closures are code of their own.
struct FlowChanges {
  std::unordered_set<Variable const*> assigned;
  std::vector<std::pair<ast::Expr const*, base::Span>> released;  ///< a variable's name, and the place of the release
  bool picks = false;
  bool calls = false;  ///< something of which the effect is not known

  void add(ast::Stmt const& statement, Resolution const& resolution);
  void add(ast::Block const& block, Resolution const& resolution);
  void add(ast::Expr const& expr, Resolution const& resolution);
};

/// What code that runs at other times than where it stands does: closures and functions.
struct DeferredChanges {
  std::unordered_set<Variable const*> assigned;
  bool picks = false;
};
[[nodiscard]] DeferredChanges deferred_changes(ast::Program const& program, Resolution const& resolution);

}  // namespace lapwing::dolphin
