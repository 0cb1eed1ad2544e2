#pragma once

#include <memory>
#include <string>
#include <unordered_set>

#include "base/text/diagnostic.hpp"
#include "dolphin/code/bytecode.hpp"
#include "dolphin/syntax/ast.hpp"
#include "tasks/vocabulary.hpp"

namespace lapwing::dolphin {

/// Turns a checked tree into a program. Reports what it cannot compile (`break` outside a loop); nothing then.
[[nodiscard]] std::shared_ptr<Program const> compile(ast::Program const& tree,
                                                     std::shared_ptr<base::SourceFile const> source,
                                                     tasks::Vocabulary const& vocabulary,
                                                     base::Diagnostics& diagnostics);

/// What was typed at `ask`, if it is an expression of literals, the program's global variables and pure functions;
/// nothing when it is not, so that it is a plain text.
[[nodiscard]] std::shared_ptr<Function const> compile_answer(std::string const& text, Program const& program);

}  // namespace lapwing::dolphin
