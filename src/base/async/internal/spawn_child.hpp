#pragma once

#include <sys/types.h>

#include "base/async/child_program.hpp"

namespace lapwing::base::internal {

/// What a program has in place of its standard files: our numbers of them.
struct ChildFiles {
  int in = -1;  ///< less than zero: nothing to read
  int out = -1;
  int errors = -1;
};

/// Starts it within its limits, with no other file, no signal held back, and in a group of its own: a Ctrl+C for this
/// program is none for it. Gives 0, or the system's number of what went wrong.
[[nodiscard]] int spawn_child(ChildProgram const& child, ChildFiles const& files, pid_t& pid);

}  // namespace lapwing::base::internal
