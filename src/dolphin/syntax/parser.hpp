#pragma once

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// Reads the script that `diagnostics` is about (`diagnostics.source()`). Never fails: what is wrong is reported and
/// left out of the tree (or an ErrorExpr), so the tree may be checked but must not be run when
/// `diagnostics.has_errors()`. Linear in the size of the text; nesting beyond `ast::max_tree_height` is an error.
[[nodiscard]] ast::Program parse(base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
