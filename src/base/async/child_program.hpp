#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"

namespace lapwing::base {

/// Another program that does a piece of work for this one, and how much it may take for that.
struct ChildProgram {
  std::filesystem::path program;
  std::vector<std::string> words = {};                        ///< after its name
  std::chrono::seconds longest{60};                           ///< of wall time, whatever the loop's pace; 0: no limit
  std::uint64_t most_memory_bytes = std::uint64_t{2} << 30U;  ///< of address space
  std::uint64_t most_file_bytes = std::uint64_t{256} << 20U;  ///< of each file that it writes
  int niceness = 10;                                          ///< to whoever else wants the processor
};

/// How it ended by itself.
struct ChildOutcome {
  int exit_code = 0;        ///< 128 and the signal, when one ended it
  std::string errors = {};  ///< the last of what it wrote to standard error
};

/// Starts the program with nothing to read and waits for its end; `heard` is given each line that it writes to standard
/// output, on the loop. Whoever lets go of the task ends the program.
/// Errors: not_found when there is no such program; io; timed_out.
[[nodiscard]] Task<Result<ChildOutcome>> run_child(Loop& loop, ChildProgram child,
                                                   std::function<void(std::string_view line)> heard = {});

}  // namespace lapwing::base
