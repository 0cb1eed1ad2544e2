#pragma once

#include "dolphin/names/resolver.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// A loop that only `return`, an exception or the end of the program leaves.
[[nodiscard]] bool never_ends(ast::Stmt const& statement);

/// Goes round and round without waiting: nothing in the loop can wait or leave it, and what it tests can change by
/// nothing in it. Says no where code is called that it does not see.
[[nodiscard]] bool spins(ast::Expr const* condition, ast::Block const& body, Resolution const& resolution);

}  // namespace lapwing::dolphin
