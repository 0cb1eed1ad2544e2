#pragma once

#include <string>

#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// The tree as s-expressions, one line for each statement of the script: `a | b / {c}` is `(| a (/ b {c}))`. For tests
/// and for people who wonder how a line is read.
[[nodiscard]] std::string print_tree(ast::Program const& program);
[[nodiscard]] std::string print_tree(ast::Expr const& expr);
[[nodiscard]] std::string print_tree(ast::Stmt const& statement);

}  // namespace lapwing::dolphin
