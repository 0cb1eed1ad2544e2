#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "dolphin/check/inference.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

struct RehearsalProblem {
  base::Span place;  ///< of the command; empty when it is the block as a whole
  base::Error error;
};

struct RehearsalDoubt {
  base::Span place;  ///< as above
  tasks::Doubt doubt;
};

/// How it went: a problem, a task, or neither.
struct Rehearsal {
  std::optional<RehearsalProblem> problem;
  std::shared_ptr<tasks::PlatformTask const> task;  ///< where its numbers are not known before, with others
  std::optional<base::Span> unreached = {};         ///< the first command behind one that never ends
  std::vector<RehearsalDoubt> doubts = {};          ///< only where every number is known
};

/// Builds a block whose statements are all commands of the platform, with those arguments that are the same in every
/// run and stand-ins for the others, and gives what the platform refuses. Says nothing about commands with stand-ins,
/// nor about blocks with other code.
[[nodiscard]] Rehearsal rehearsal(ast::Closure const& body, tasks::BuilderSpec const& builder, Inference& inference);

}  // namespace lapwing::dolphin
