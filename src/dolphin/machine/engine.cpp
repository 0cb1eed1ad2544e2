#include "dolphin/machine/engine.hpp"

#include <fmt/format.h>

#include "base/assert.hpp"
#include "base/async/scope.hpp"
#include "dolphin/check/checker.hpp"
#include "dolphin/code/compiler.hpp"
#include "dolphin/machine/fiber.hpp"
#include "dolphin/names/instruction_table.hpp"
#include "dolphin/syntax/parser.hpp"

namespace lapwing::dolphin {
namespace {

base::Task<void> drive_and_notify(Runtime& runtime, Fiber& fiber, bool& is_done, base::Notifier& changed) {
  auto driving = drive(runtime, fiber);
  co_await driving;
  is_done = true;
  changed.notify_all();
}

Outcome outcome_of(Fiber const& fiber, Program const& program) {
  if (fiber.state() == Fiber::State::returned) return {};
  auto const& error = fiber.error().as<Error>()->value;
  Outcome outcome{
      .kind = Outcome::Kind::halted, .message = error.message, .file = program.source->name(), .line = error.line};
  if (error.ending == Ending::error) {
    outcome.kind = Outcome::Kind::script_error;
    outcome.type = error.type;
    outcome.message = error.type + ": " + error.message;
  }
  return outcome;
}

/// As the original engine prints it, and where it was.
std::string unexpected(Outcome const& outcome) {
  auto const message = std::string_view(outcome.message).substr(outcome.type.size() + 2);
  return fmt::format("Unexpected exception ...  {} : {} ! ({}:{})", outcome.type, message, outcome.file, outcome.line);
}

}  // namespace

std::shared_ptr<Program const> load(std::shared_ptr<base::SourceFile const> source, tasks::Vocabulary const& vocabulary,
                                    base::Diagnostics& diagnostics) {
  auto const tree = parse(diagnostics, names_of(vocabulary));
  check(tree, vocabulary, diagnostics);
  if (diagnostics.has_errors()) return nullptr;
  return compile(tree, std::move(source), vocabulary, diagnostics);
}

int exit_code(Outcome const& outcome) {
  switch (outcome.kind) {
    case Outcome::Kind::done: return 0;
    case Outcome::Kind::script_error: return 1;
    case Outcome::Kind::halted: return 3;
    case Outcome::Kind::stopped: return 130;
  }
  return 1;
}

std::string to_text(Outcome const& outcome) {
  std::string const place = outcome.line > 0 ? fmt::format("{}:{}: ", outcome.file, outcome.line) : std::string();
  switch (outcome.kind) {
    case Outcome::Kind::done: return "completed";
    case Outcome::Kind::script_error: return place + outcome.message;
    case Outcome::Kind::halted: return place + "Halting program ... " + outcome.message;
    case Outcome::Kind::stopped: return "stopped";
  }
  return {};
}

Engine::Engine(base::Loop& loop, tasks::Platform& platform, Output& output, base::Logger log, EngineOptions options)
    : loop_(loop),
      platform_(platform),
      output_(output),
      log_(std::move(log)),
      options_(std::move(options)),
      changed_(loop) {}

Engine::~Engine() = default;

base::Task<Outcome> Engine::run(std::shared_ptr<Program const> program) {
  LAPWING_ASSERT(!is_running());
  is_stopping_ = false;
  runtime_.reset(new Runtime{.loop = loop_,
                             .platform = platform_,
                             .output = output_,
                             .log = log_,
                             .program = std::move(program),
                             .limits = options_.limits,
                             .tick = options_.tick,
                             .random = std::mt19937_64(options_.seed),
                             .observer = options_.on_event,
                             .on_executed = options_.on_executed});
  runtime_->globals.resize(runtime_->program->globals.size());
  runtime_->is_defined.resize(runtime_->program->globals.size());
  auto running = run_script(*runtime_);
  auto outcome = co_await running;
  runtime_.reset();
  co_return outcome;
}

base::Task<Outcome> Engine::run_script(Runtime& runtime) {
  auto const& name = runtime.program->source->name();
  log_.info(fmt::format("Running script '{}'", name));
  Outcome outcome;
  {
    Fiber fiber(runtime, Fiber::Role::script);
    script_ = &fiber;
    fiber.begin(*runtime.program->main);
    bool is_done = false;
    base::Scope scope(loop_);
    scope.spawn(drive_and_notify(runtime, fiber, is_done, changed_));
    while (!is_done && !is_stopping_) co_await changed_.wait();
    scope.clear();  // ends the running `execute`, which stops its tasks
    fiber.unwind(runtime.limits.slice);
    outcome = is_done ? outcome_of(fiber, *runtime.program) : Outcome{.kind = Outcome::Kind::stopped};
    script_ = nullptr;
  }
  runtime.picked.clear();
  auto settling = platform_.settle();
  co_await settling;
  if (outcome.kind == Outcome::Kind::done) log_.info(fmt::format("Script '{}' completed", name));
  if (outcome.kind == Outcome::Kind::stopped) log_.warn("Script interrupted!");
  if (outcome.kind == Outcome::Kind::halted) log_.error("Halting program ... " + outcome.message);
  if (outcome.kind == Outcome::Kind::script_error) log_.error(unexpected(outcome));
  co_return outcome;
}

void Engine::stop() {
  if (!runtime_) return;
  is_stopping_ = true;
  changed_.notify_all();
}

std::optional<tasks::TaskView> Engine::task_view() const {
  if (!runtime_ || !runtime_->execution) return std::nullopt;
  return runtime_->execution->view();
}

std::vector<tasks::VehicleId> Engine::picked() const {
  return runtime_ ? runtime_->picked : std::vector<tasks::VehicleId>();
}

int Engine::line() const {
  return script_ ? static_cast<int>(script_->line()) : 0;
}

}  // namespace lapwing::dolphin
