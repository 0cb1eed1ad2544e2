#pragma once

#include <expected>
#include <memory>
#include <optional>
#include <string>

/// How a script's closures take part in running tasks. The language implements these; nothing here knows a language.
namespace lapwing::tasks {

/// An exception or a halt ends the tick where it happens; of several task errors in one tick the leftmost is reported.
enum class FailureKind {
  task,       ///< a task ended in ERROR: travels up to the nearest watch, cancelling siblings on its way
  exception,  ///< a closure threw: as `task` within a watch; else the whole tree is stopped and the caller gets it
  halt,       ///< the script asked to end: no watch stops it
};

struct Failure {
  FailureKind kind = FailureKind::task;
  std::string message;
  /// The script's own exception value, untouched on its way from the closure to the watch handler or to `execute`'s
  /// caller. Shared because a failure is copied freely and its owner, the language, is unknown here.
  std::shared_ptr<void const> payload = {};
  /// Which task failed, on which vehicle, for people: "survey on a1". Empty when no platform task was the cause.
  std::string culprit = {};
  bool vehicle_failed = false;  ///< the vehicle or the way to it broke down, not the task
};

/// `{ battery(v) < 0.3 }`: evaluated at once, every tick while it matters. Its side effects are part of a script's
/// meaning.
class Guard {
 public:
  virtual ~Guard() = default;
  [[nodiscard]] virtual std::expected<bool, Failure> test() const = 0;
};

/// What a watch handler decided. An action's verdict is not looked at.
enum class Verdict { propagate, ignore };
enum class CallState { suspended, returned };

/// One run of a closure that may take several ticks (`pause 5` in an action). Destroying it cancels what is left of it.
class Call {
 public:
  virtual ~Call() = default;
  /// Runs until the closure returns or suspends. Called once a tick until it has returned or failed; never after.
  [[nodiscard]] virtual std::expected<CallState, Failure> step() = 0;
  /// Valid once returned.
  [[nodiscard]] virtual Verdict verdict() const { return Verdict::propagate; }
};

/// The body of an action or of a watch handler: can be run any number of times, also several at once.
class Procedure {
 public:
  virtual ~Procedure() = default;
  /// `cause`: what a watch handler is called about; nothing for an action. The body itself first runs in `Call::step`.
  [[nodiscard]] virtual std::unique_ptr<Call> begin(std::optional<Failure> cause) const = 0;
};

}  // namespace lapwing::tasks
