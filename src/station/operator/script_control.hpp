#pragma once

#include <expected>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text/diagnostic.hpp"
#include "tasks/task_view.hpp"

namespace lapwing::station {

/// idle: none was started yet · stopping: asked to end, vehicles are still being put into their stop state · stopped:
/// an operator wanted it to end, which is no failure.
enum class ScriptState { idle, running, stopping, stopped, done, failed };
[[nodiscard]] std::string_view to_string(ScriptState state);

/// The station's one script as an operator sees it.
struct ScriptStatus {
  std::string name;  ///< file name, or what the starter called it
  std::string source;
  ScriptState state = ScriptState::idle;
  std::string message;  ///< why it failed, who stopped it, or what it waits for; may be empty
  std::vector<base::DiagnosticRecord> diagnostics;  ///< of the last check, warnings included
};

/// Why a script did not start. `refused`: another one runs; `invalid_input`: it does not check, see the diagnostics.
struct StartFailure {
  base::Error error;
  std::vector<base::DiagnosticRecord> diagnostics;
};

/// What the station needs of a language engine: start, stop, look. `apps` adapts the engine to it.
///
/// The station looks several times a second and sends what changed, so the two queries should be cheap. Thread-bound.
class ScriptControl {
 public:
  virtual ~ScriptControl() = default;

  [[nodiscard]] virtual ScriptStatus status() const = 0;
  /// The task trees of the running (or last) script, oldest first.
  [[nodiscard]] virtual std::vector<tasks::TaskView> task_trees() const = 0;

  /// Checks `source` and starts it. Returns at once; how it goes on shows in `status`.
  [[nodiscard]] virtual std::expected<void, StartFailure> start(std::string name, std::string source) = 0;
  /// Ends the script and puts its vehicles into their stop state, and tells who wanted that. Does nothing when none
  /// runs; may be repeated.
  virtual void stop(std::string by) = 0;
};

}  // namespace lapwing::station
