#pragma once

#include "base/text/diagnostic.hpp"
#include "dolphin/check/flow/internal/vehicle_facts.hpp"
#include "dolphin/check/internal/task_shape.hpp"
#include "dolphin/syntax/ast.hpp"

namespace lapwing::dolphin {

/// What is known where an `execute` stands.
struct ExecuteContext {
  Resolution const& resolution;
  TaskShapes& tasks;
  VehicleState const& state;  ///< of the variables that can be followed
  base::Diagnostics& diagnostics;
};

/// Whether the vehicles can be had that the tasks of this `execute` need. Reports one mistake at most.
void check_execute(ExecuteContext context, ast::Call const& execute);

}  // namespace lapwing::dolphin
