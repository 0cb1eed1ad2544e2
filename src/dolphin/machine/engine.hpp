#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/task.hpp"
#include "base/log.hpp"
#include "base/text/diagnostic.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/output.hpp"
#include "tasks/execution.hpp"
#include "tasks/platform.hpp"

namespace lapwing::dolphin {

/// Reads, checks and compiles a script. Everything that is wrong goes to `diagnostics`, which is about `*source`;
/// nothing when there are errors. `vocabulary`: what the platform adds.
[[nodiscard]] std::shared_ptr<Program const> load(std::shared_ptr<base::SourceFile const> source,
                                                  tasks::Vocabulary const& vocabulary, base::Diagnostics& diagnostics);

/// How a program ended.
struct Outcome {
  enum class Kind {
    done,          ///< ran to its end
    script_error,  ///< an exception that nothing caught
    halted,        ///< by `halt`, or because it could not get its vehicles
    stopped,       ///< by `Engine::stop`
  };
  Kind kind = Kind::done;
  std::string message = {};  ///< what people read: the exception, the text of `halt`
  std::string file = {};
  int line = 0;           ///< 0: unknown
  std::string type = {};  ///< of the exception
};

/// The exit code of a program that runs one script: 0 done, 1 script error, 3 halted, 130 stopped.
[[nodiscard]] int exit_code(Outcome const& outcome);
/// "survey.dolphin:12: TaskError: boom"
[[nodiscard]] std::string to_text(Outcome const& outcome);

struct EngineOptions {
  Limits limits = {};
  base::Duration tick = tasks::default_tick;
  std::uint64_t seed = 1;                                 ///< of `Math.random()`; the same in every run unless set
  tasks::Execution::Observer on_event = {};               ///< ALLOC, START, DONE, ERROR and STOP of tasks
  std::function<void(tasks::TaskView)> on_executed = {};  ///< each `execute`, as it stood at its end
};

/// Runs scripts on a platform, one after the other.
///
/// However a script ends, its running tasks are stopped, `finally` blocks on the way out run (without waiting when it
/// is stopped from outside), its vehicles released, and the platform has settled before the outcome is there.
/// Thread-bound to its loop.
class Engine {
 public:
  /// All outlive the engine.
  Engine(base::Loop& loop, tasks::Platform& platform, Output& output, base::Logger log, EngineOptions options = {});
  ~Engine();

  /// Precondition: no other script is running.
  [[nodiscard]] base::Task<Outcome> run(std::shared_ptr<Program const> program);
  /// Ends the running script from outside: an operator's stop, Ctrl-C. Does nothing when none is running.
  void stop();

  [[nodiscard]] bool is_running() const { return runtime_ != nullptr; }
  /// The task tree that `execute` is running; nothing between two.
  [[nodiscard]] std::optional<tasks::TaskView> task_view() const;
  [[nodiscard]] std::vector<tasks::VehicleId> picked() const;
  /// The line that the script itself has got to; 0 when none is running.
  [[nodiscard]] int line() const;

 private:
  base::Task<Outcome> run_script(Runtime& runtime);

  base::Loop& loop_;
  tasks::Platform& platform_;
  Output& output_;
  base::Logger log_;
  EngineOptions options_;
  base::Notifier changed_;
  std::unique_ptr<Runtime> runtime_;
  Fiber* script_ = nullptr;
  bool is_stopping_ = false;
};

}  // namespace lapwing::dolphin
