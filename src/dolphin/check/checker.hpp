#pragma once

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"
#include "tasks/vocabulary.hpp"

namespace lapwing::dolphin {

/// Finds what can be known to be wrong before anything moves: names, commands, fields, units, arity, argument types and
/// dimensions, directions, keys, chains, code that cannot run, tasks never executed. `vocabulary` is what the
/// platform adds that the script is meant for (`mission { ... }`, `sendMessage`). Reports everything in one run; a
/// script with errors must not be run.
void check(ast::Program const& program, tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
