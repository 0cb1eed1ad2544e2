#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "tasks/allocation.hpp"
#include "tasks/task_view.hpp"

namespace lapwing::tasks {

namespace internal {
class Executor;
struct Context;
}  // namespace internal

/// How an execution ended. No failure and not stopped: DONE.
struct Outcome {
  std::optional<Failure> failure = std::nullopt;
  bool is_stopped = false;  ///< by `Execution::stop`
  [[nodiscard]] bool is_done() const { return !failure && !is_stopped; }
};

/// A task tree on its way: one executor per occurrence, stepped depth first, left to right, once a tick (language
/// spec, 4.3).
///
/// Whatever way it ends, every platform task that was started has ended or has been stopped, exactly once; a task that
/// was never started is never stopped. Reads no clock: whoever drives it says what time it is, and never goes back.
/// Must not be destroyed from within one of its own guards or actions.
class Execution {
 public:
  using Observer = std::function<void(TaskEvent const&)>;

  /// `platform` and what `observer` refers to outlive the execution. `allocation` is that of `tree`.
  Execution(TaskTree const& tree, Allocation allocation, Platform& platform, Observer observer = {});
  /// Stops what still runs.
  ~Execution();
  Execution(Execution const&) = delete;
  Execution& operator=(Execution const&) = delete;

  /// Reports the allocation and starts what runs from the outset. Once, before the first step.
  void start(base::TimePoint now);
  /// One tick. True when the execution has ended; further steps then do nothing.
  bool step(base::TimePoint now);
  /// Ends it from outside. Does nothing when it has ended.
  void stop(base::TimePoint now);
  /// The vehicle is taken away (`release`): what runs on it is stopped and fails, what would start on it later fails
  /// then. May be called from within the execution's own actions.
  void withdraw(VehicleId const& vehicle);

  [[nodiscard]] std::optional<Outcome> const& outcome() const { return outcome_; }
  [[nodiscard]] TaskView view() const;

 private:
  std::unique_ptr<internal::Context> context_;
  Allocation allocation_;
  std::unique_ptr<internal::Executor> root_;
  std::optional<Outcome> outcome_;
};

inline constexpr base::Duration default_tick = std::chrono::milliseconds(100);

/// Starts `execution` and steps it every `tick` of the loop's time until it has ended, then waits out that tick: an
/// `execute` takes at least one, so a loop round it cannot starve the program. Ticks are multiples of `tick` after the
/// start; those the loop was too busy to serve are skipped. Cancelling this leaves the execution as it is: stop or
/// destroy it.
[[nodiscard]] base::Task<Outcome> run(base::Loop& loop, Execution& execution, base::Duration tick = default_tick);

}  // namespace lapwing::tasks
