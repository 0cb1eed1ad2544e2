#pragma once

#include "base/text/diagnostic.hpp"
#include "dolphin/check/internal/task_shape.hpp"
#include "dolphin/names/resolver.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// Follows vehicle sets through a script and its functions, from `pick` to `execute` and `release`: vehicles that are
/// used after their release, one vehicle for two tasks at once, more tasks at once than vehicles, tasks that the picked
/// vehicles cannot do. Errors are only what fails in every run that comes there; inside `try` a script may mean to
/// fail. Loops and branches are not counted out: what they change is unknown behind them. Linear in the size of the
/// script (times the depth of its nesting).
void check_vehicle_flow(ast::Program const& program, Resolution const& resolution, Inference& inference,
                        TaskShapes& tasks, base::Diagnostics& diagnostics);

}  // namespace lapwing::dolphin
