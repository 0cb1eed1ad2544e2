#include "host/session/script_host.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

/// A patrol that loops for days must not fill memory with its past.
constexpr std::size_t max_kept_trees = 100;

}  // namespace

std::string outcome_word(dolphin::Outcome const& outcome) {
  switch (outcome.kind) {
    case dolphin::Outcome::Kind::done: return "done";
    case dolphin::Outcome::Kind::script_error: return "error";
    case dolphin::Outcome::Kind::halted: return "halted";
    case dolphin::Outcome::Kind::stopped: return "interrupted";
  }
  return "error";
}

std::string to_log_text(tasks::TaskEvent const& event) {
  return fmt::format("{} {}{}{}{}", to_string(event.kind), event.task,
                     event.vehicle ? " vehicle=" + event.vehicle->text : "", event.detail.empty() ? "" : ": ",
                     event.detail);
}

ScriptHost::ScriptHost(base::Loop& loop, tasks::Platform& platform, dolphin::Output& output, base::Logger log,
                       tasks::Execution::Observer on_event, std::uint64_t seed)
    : loop_(loop),
      platform_(platform),
      log_(log.named("engine")),
      engine_(loop, platform, output, log.named("engine"),
              {.seed = seed,
               .on_event = std::move(on_event),
               .on_executed = [this](tasks::TaskView tree) { keep(std::move(tree)); }}),
      ended_(loop),
      scope_(loop) {}

std::vector<tasks::TaskView> ScriptHost::task_trees() const {
  auto trees = finished_trees_;
  if (auto running = engine_.task_view()) trees.push_back(std::move(*running));
  return trees;
}

std::expected<void, station::StartFailure> ScriptHost::start(std::string name, std::string source) {
  if (engine_.is_running()) {
    auto const message = fmt::format("{} is still running", status_.name);
    return std::unexpected(station::StartFailure{{base::ErrorKind::refused, message, "stop it first"}, {}});
  }
  if (auto const reason = bar_ ? bar_() : std::nullopt)
    return std::unexpected(station::StartFailure{{base::ErrorKind::refused, *reason, {}}, {}});
  auto const file = std::make_shared<base::SourceFile const>(name, source);
  base::Diagnostics diagnostics(*file);
  auto program = dolphin::load(file, platform_.vocabulary(), diagnostics);
  auto records = base::to_records(diagnostics);
  rendered_ = base::render(diagnostics);
  if (!program) {
    auto const message = fmt::format("{} does not check: {} error{}", name, diagnostics.error_count(),
                                     diagnostics.error_count() == 1 ? "" : "s");
    return std::unexpected(station::StartFailure{{base::ErrorKind::invalid_input, message, {}}, std::move(records)});
  }
  status_ = {.name = std::move(name),
             .source = std::move(source),
             .state = station::ScriptState::running,
             .message = {},
             .diagnostics = std::move(records)};
  finished_trees_.clear();
  halt_reason_.reset();
  stopped_by_.clear();
  is_operators_halt_ = false;
  started_ = loop_.utc_now();
  scope_.spawn(run(std::move(program)));
  return {};
}

base::Task<> ScriptHost::run(std::shared_ptr<dolphin::Program const> program) {
  auto outcome = co_await engine_.run(program);
  if (halt_reason_) outcome = {.kind = dolphin::Outcome::Kind::halted, .message = *halt_reason_, .file = status_.name};
  finished_ = loop_.utc_now();
  status_.state = state_after(outcome);
  status_.message = status_.state == station::ScriptState::done ? "" : dolphin::to_text(outcome);
  if (status_.state == station::ScriptState::stopped)
    status_.message = halt_reason_ ? *halt_reason_ : fmt::format("stopped by {}", stopped_by_);
  if (halt_reason_) log_.error(*halt_reason_);
  outcome_ = std::move(outcome);
  ended_.notify_all();
}

station::ScriptState ScriptHost::state_after(dolphin::Outcome const& outcome) const {
  if (outcome.kind == dolphin::Outcome::Kind::done) return station::ScriptState::done;
  bool const is_operators_wish = outcome.kind == dolphin::Outcome::Kind::stopped || is_operators_halt_;
  return is_operators_wish ? station::ScriptState::stopped : station::ScriptState::failed;
}

void ScriptHost::stop(std::string by) {
  if (engine_.is_running() && stopped_by_.empty()) stopped_by_ = std::move(by);
  begin_stop();
}

void ScriptHost::begin_stop() {
  if (!engine_.is_running()) return;
  if (status_.state != station::ScriptState::stopping)
    log_.warn("stopping: vehicles are being put into their stop mode");
  status_.state = station::ScriptState::stopping;
  engine_.stop();
}

void ScriptHost::halt(std::string reason) {
  if (!engine_.is_running()) return;
  halt_reason_ = std::move(reason);
  begin_stop();
}

void ScriptHost::halt_for_operator(std::string reason) {
  if (!engine_.is_running()) return;
  is_operators_halt_ = true;
  halt(std::move(reason));
}

base::Task<> ScriptHost::halt_after(base::Duration timeout) {
  co_await loop_.sleep(timeout);
  halt(fmt::format("time-out: the script still ran after {:g} s", base::to_seconds(timeout)));
}

StallWatch ScriptHost::halt_when_time_stands_still(std::chrono::seconds patience) {
  return StallWatch(loop_, patience, [this, patience] {
    halt(fmt::format("the script let no time pass for {} s: it waits for nothing and never ends", patience.count()));
  });
}

base::Task<> ScriptHost::ended() {
  while (engine_.is_running() || status_.state == station::ScriptState::running) co_await ended_.wait();
}

void ScriptHost::keep(tasks::TaskView tree) {
  if (finished_trees_.size() == max_kept_trees) finished_trees_.erase(finished_trees_.begin());
  finished_trees_.push_back(std::move(tree));
}

}  // namespace lapwing::host
