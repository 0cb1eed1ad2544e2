#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "dolphin/machine/engine.hpp"
#include "host/session/report.hpp"
#include "host/session/stall_watch.hpp"
#include "station/operator/script_control.hpp"
#include "tasks/platform.hpp"

namespace lapwing::host {

/// The one script of a process: checks it, runs it on the engine, stops it, and keeps what is to be told about it.
/// `run` waits for its end, the station shows it.
class ScriptHost final : public station::ScriptControl {
 public:
  /// `platform` and `output` outlive the host. `seed`: of what scripts draw by lot.
  ScriptHost(base::Loop& loop, tasks::Platform& platform, dolphin::Output& output, base::Logger log,
             tasks::Execution::Observer on_event = {}, std::uint64_t seed = 1);

  [[nodiscard]] station::ScriptStatus status() const override { return status_; }
  [[nodiscard]] std::vector<tasks::TaskView> task_trees() const override;
  [[nodiscard]] std::expected<void, station::StartFailure> start(std::string name, std::string source) override;
  void stop(std::string by) override;

  /// Asked before a script starts: a reason refuses it.
  void set_bar(std::function<std::optional<std::string>()> bar) { bar_ = std::move(bar); }
  /// Like `stop`, for another reason than the operator's wish; the outcome then is halted, with that reason.
  void halt(std::string reason);
  /// The same when it is an operator's: shown as stopped, not as failed.
  void halt_for_operator(std::string reason);
  /// Halts the script when it still runs after so much of the loop's time. Cancelling this calls it off.
  [[nodiscard]] base::Task<> halt_after(base::Duration timeout);
  /// As long as it lives, a script that is busy without letting any time pass is halted after `patience` of the wall's
  /// clock: on a loop without pace it would never end.
  [[nodiscard]] StallWatch halt_when_time_stands_still(std::chrono::seconds patience = std::chrono::seconds(30));
  /// Ends when no script runs.
  [[nodiscard]] base::Task<> ended();

  /// Of the script that ran last; nothing before the first has ended.
  [[nodiscard]] std::optional<dolphin::Outcome> const& outcome() const { return outcome_; }
  /// What the last start had to say about the script's text, ready to print.
  [[nodiscard]] std::string const& rendered_diagnostics() const { return rendered_; }
  [[nodiscard]] base::UtcTime started() const { return started_; }
  [[nodiscard]] base::UtcTime finished() const { return finished_; }

 private:
  base::Task<> run(std::shared_ptr<dolphin::Program const> program);
  void begin_stop();
  [[nodiscard]] station::ScriptState state_after(dolphin::Outcome const& outcome) const;
  void keep(tasks::TaskView tree);

  base::Loop& loop_;
  tasks::Platform& platform_;
  base::Logger log_;
  dolphin::Engine engine_;
  station::ScriptStatus status_;
  std::string rendered_;
  std::vector<tasks::TaskView> finished_trees_;
  std::function<std::optional<std::string>()> bar_;
  std::optional<std::string> halt_reason_;
  std::string stopped_by_;
  bool is_operators_halt_ = false;
  std::optional<dolphin::Outcome> outcome_;
  base::UtcTime started_{};
  base::UtcTime finished_{};
  base::Notifier ended_;
  base::Scope scope_;
};

/// "START survey vehicle=1", for the log.
[[nodiscard]] std::string to_log_text(tasks::TaskEvent const& event);

/// "done", "error", "halted" or "interrupted": the report's word for the outcome.
[[nodiscard]] std::string outcome_word(dolphin::Outcome const& outcome);

}  // namespace lapwing::host
