#pragma once

#include <span>
#include <string_view>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// Reads the script that `diagnostics` is about (`diagnostics.source()`). Never fails: what is wrong is reported and
/// left out of the tree (or an ErrorExpr), so the tree may be checked but must not be run when
/// `diagnostics.has_errors()`. Linear in the size of the text; nesting beyond `ast::max_tree_height` is an error.
/// `instructions`: words without a value besides the language's own; what stands behind them is theirs as a whole.
[[nodiscard]] ast::Program parse(base::Diagnostics& diagnostics, std::span<std::string_view const> instructions = {});

}  // namespace lapwing::dolphin
