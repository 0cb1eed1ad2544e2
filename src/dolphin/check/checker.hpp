#pragma once

#include <span>

#include "base/text/diagnostic.hpp"
#include "dolphin/syntax/ast.hpp"
#include "tasks/platform.hpp"

namespace lapwing::dolphin {

/// Finds what can be known to be wrong before anything moves: names, commands, fields, units, arity, argument types and
/// dimensions, directions, keys, chains, code that cannot run, tasks never executed. `builders` are the block words of
/// the platform the script is meant for (`mission { ... }`). Reports everything in one run; a script with errors must
/// not be run.
void check(ast::Program const& program, std::span<tasks::BuilderSpec const> builders, base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
