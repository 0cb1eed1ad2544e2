#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

/// What a script may be and may use up, in one place. Beyond a limit of reading there is a diagnostic, beyond one of
/// running an exception in the script: never a crash or a hanging program. Those of two neighbours stand with them:
/// `ast::max_tree_height` and, for tasks, `tasks::max_task_depth` and `tasks::max_task_size`.
namespace lapwing::dolphin {

// ---- reading
/// The longest scripts that are read; longer ones are refused with a diagnostic.
inline constexpr std::size_t max_source_size = std::size_t{16} << 20u;
inline constexpr std::size_t max_token_count = 4'000'000;

// ---- values
/// Bytes of a text that `+`, interpolation, `join` or `replace` makes.
inline constexpr std::size_t max_text_size = std::size_t{1} << 20u;
/// What a list or map prints before it is cut with "…".
inline constexpr std::size_t max_printed_size = std::size_t{1} << 20u;
inline constexpr int max_printed_depth = 32;
/// Values compared by one operation such as `list - list` or `unique`: about a second's work.
inline constexpr std::size_t max_comparisons = 50'000'000;
/// Values looked at by one `list.member`, nested lists included.
inline constexpr std::size_t max_spread_values = 1'000'000;
/// Bytes of text that one search for all matches of a pattern may look at: about a second's work.
inline constexpr std::size_t max_matched_bytes = 1'000'000'000;
/// Numbers of a range that is made a list.
inline constexpr std::int64_t max_copied_range = 10'000'000;
/// What a call of a built-in instruction, such as `println`, counts among the steps without waiting.
inline constexpr std::uint64_t steps_of_native = 100;
/// What one instruction takes of the time of the loop, so that time goes on for everything else, and runs out, while a
/// script computes: in simulated time, too, and then the same in every run.
inline constexpr auto time_of_step = std::chrono::nanoseconds(20);
/// Signals that are posted and not consumed.
inline constexpr std::size_t max_signals = 10'000;

/// Those that the program may set.
struct Limits {
  std::size_t heap_bytes = std::size_t{256} << 20U;
  std::size_t call_depth = 10'000;
  std::size_t stack_values = 1'000'000;  ///< variables and operands of all calls under way
  int slice = 20'000;                    ///< instructions between two turns of the loop
  int guard_budget = 2'000'000;          ///< instructions one test of a guard may take
  /// Instructions without waiting for anything, ten seconds of them: then a loop has no end. A call of a built-in
  /// instruction counts as many.
  std::uint64_t busy_steps = 500'000'000;
  /// Instructions of the whole run, then it ends as if halted. None: a patrol goes on for days.
  std::uint64_t steps = UINT64_MAX;
};

}  // namespace lapwing::dolphin
