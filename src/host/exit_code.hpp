#pragma once

#include "base/error.hpp"

namespace lapwing::host {

/// Exit codes of every verb (docs/reference/command-line.md).
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,        ///< script error at run time; doctor found something wrong; fmt --check did
  exit_usage = 2,         ///< does not check, bad usage
  exit_halted = 3,        ///< halt, no vehicle found, link or vehicle failure
  exit_interrupted = 130  ///< interrupted, vehicles made safe
};

/// Prints an error the way every verb does: what went wrong, then what to do.
void print_error(base::Error const& error);
/// The same; returns the exit code that goes with it: bad usage when the request itself is wrong, halted otherwise.
[[nodiscard]] int refuse(base::Error const& error);

}  // namespace lapwing::host
