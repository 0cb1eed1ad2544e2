#include "apps/vehicles/run/harness_run.hpp"

#include <memory>

#include <fmt/format.h>

#include "apps/verb.hpp"
#include "base/async/scope.hpp"
#include "host/session/console.hpp"
#include "host/session/script_host.hpp"
#include "host/session/signals.hpp"
#include "host/simulation/simulation.hpp"
#include "missions/mission_harness.hpp"

namespace lapwing::apps {

namespace {

/// Vehicles, console and engine for scripts that fly nowhere.
class HarnessRun {
 public:
  explicit HarnessRun(HarnessOptions options)
      : timeout_(options.timeout),
        events_(std::move(options.events)),
        loop_(host::pace_for(0.0, options.seed)),
        log_(hub_, "lapwing"),
        platform_(loop_, std::move(options.plans.library)),
        console_(host::make_console(loop_, log_)),
        host_(
            loop_, platform_, *console_, log_, [this](tasks::TaskEvent const& event) { note(event); },
            options.seed.value_or(1)) {
    hub_.add_sink([to_terminal = base::standard_error_sink(base::LogLevel::info)](base::LogRecord const& record) {
      if (record.source != host::script_source) to_terminal(record);
    });
    for (auto const& mistake : options.plans.mistakes) log_.warn(mistake.message);
  }

  /// Returns the exit code.
  int run(host::ScriptText const& script) {
    auto const started = host_.start(script.name, script.text);
    fmt::print(stderr, "{}", host_.rendered_diagnostics());
    if (!started) return host::exit_usage;
    host::StopSignals const signals(loop_, [this] { host_.stop("an interrupt"); });
    auto const stall = host_.halt_when_time_stands_still();
    loop_.run_until_done(finish());
    return dolphin::exit_code(*host_.outcome());
  }

 private:
  base::Task<> finish() {
    base::Scope scope(loop_);
    if (timeout_) scope.spawn(host_.halt_after(*timeout_));
    co_await host_.ended();
  }

  void note(tasks::TaskEvent const& event) {
    auto const vehicle = event.vehicle ? platform_.find(*event.vehicle) : std::nullopt;
    events_.write(event, {.home = vehicle ? vehicle->position : std::nullopt});
    log_.named("task").info(host::to_log_text(event));
  }

  std::optional<base::Duration> timeout_;
  host::EventFile events_;
  base::Loop loop_;
  base::LogHub hub_;
  base::Logger log_;
  missions::MissionHarness platform_;
  std::unique_ptr<dolphin::Output> console_;
  host::ScriptHost host_;
};

}  // namespace

int run_on_harness(std::vector<host::ScriptText> const& scripts, HarnessOptions options) {
  HarnessRun harness(std::move(options));
  for (auto const& script : scripts) {
    if (int const code = harness.run(script); code != host::exit_done) return code;
  }
  return host::exit_done;
}

}  // namespace lapwing::apps
