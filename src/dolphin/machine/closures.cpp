#include <fmt/format.h>

#include "dolphin/machine/fiber.hpp"
#include "dolphin/machine/runtime.hpp"
#include "dolphin/value/equality.hpp"
#include "dolphin/value/text.hpp"

/// Closures of a script as guards and procedures of tasks.
namespace lapwing::dolphin {
namespace {

tasks::Failure as_failure(Value const& error) {
  auto const& data = error.as<Error>()->value;
  auto const kind = data.ending == Ending::error ? tasks::FailureKind::exception : tasks::FailureKind::halt;
  return {.kind = kind, .message = data.message, .payload = std::make_shared<Value const>(error)};
}

class ScriptGuard final : public tasks::Guard {
 public:
  ScriptGuard(Runtime& runtime, Ref<Closure> closure)
      : runtime_(runtime), closure_(std::move(closure)), fiber_(runtime, Fiber::Role::guard) {}

  [[nodiscard]] std::expected<bool, tasks::Failure> test() const override {
    int budget = runtime_.limits.guard_budget;
    fiber_.begin(closure_, {});
    switch (fiber_.run(budget)) {
      case Fiber::State::returned: return is_true(fiber_.result());
      case Fiber::State::failed: return std::unexpected(as_failure(fiber_.error()));
      default: break;
    }
    auto const line = static_cast<int>(fiber_.line());
    fiber_.abandon();
    auto message = fmt::format("a guard took more than {} steps", runtime_.limits.guard_budget);
    return std::unexpected(
        as_failure(Value(runtime_.heap.make<Error>(ErrorData{"TimeoutException", std::move(message), line}))));
  }

 private:
  Runtime& runtime_;
  Ref<Closure> closure_;
  // Kept for its stack: a guard is tested ten times a second. Between two tests it holds nothing.
  mutable Fiber fiber_;
};

class ScriptCall final : public tasks::Call {
 public:
  ScriptCall(Runtime& runtime, Ref<Closure> const& closure, Fiber::Role role, std::vector<Value> arguments)
      : runtime_(runtime), fiber_(runtime, role) {
    fiber_.begin(closure, std::move(arguments));
  }

  /// What is left of it ends as by `halt`, so that its `finally` blocks run.
  ~ScriptCall() override {
    wait_.reset();
    fiber_.unwind(runtime_.limits.slice);
  }
  ScriptCall(ScriptCall const&) = delete;
  ScriptCall& operator=(ScriptCall const&) = delete;

  [[nodiscard]] std::expected<tasks::CallState, tasks::Failure> step() override {
    int budget = runtime_.limits.slice;
    while (true) {
      if (fiber_.state() == Fiber::State::waiting && !waited()) return tasks::CallState::suspended;
      switch (fiber_.run(budget)) {
        case Fiber::State::returned: return tasks::CallState::returned;
        case Fiber::State::failed: return std::unexpected(as_failure(fiber_.error()));
        case Fiber::State::ready: return tasks::CallState::suspended;
        case Fiber::State::waiting: break;
      }
    }
  }
  [[nodiscard]] tasks::Verdict verdict() const override {
    return fiber_.ignores_failure ? tasks::Verdict::ignore : tasks::Verdict::propagate;
  }

 private:
  /// Whether what the fiber waits for has come; then it is ready again.
  bool waited() {
    if (!wait_) {
      wait_.emplace(fiber_.take_wait());
      wait_->start();
    }
    if (!wait_->done()) return false;
    auto result = wait_->take();
    wait_.reset();
    fiber_.resume(std::move(result));
    return true;
  }

  Runtime& runtime_;
  Fiber fiber_;
  std::optional<base::Task<Checked<Value>>> wait_;
};

class ScriptProcedure final : public tasks::Procedure {
 public:
  ScriptProcedure(Runtime& runtime, Ref<Closure> closure, Fiber::Role role)
      : runtime_(runtime), closure_(std::move(closure)), role_(role) {}

  [[nodiscard]] std::unique_ptr<tasks::Call> begin(std::optional<tasks::Failure> cause) const override {
    std::vector<Value> arguments;
    if (cause) arguments.emplace_back(runtime_.heap.make<Text>(cause->message));
    return std::make_unique<ScriptCall>(runtime_, closure_, role_, std::move(arguments));
  }

 private:
  Runtime& runtime_;
  Ref<Closure> closure_;
  Fiber::Role role_;
};

}  // namespace

std::shared_ptr<tasks::Guard const> make_guard(Runtime& runtime, Ref<Closure> closure) {
  return std::make_shared<ScriptGuard const>(runtime, std::move(closure));
}

std::shared_ptr<tasks::Procedure const> make_action(Runtime& runtime, Ref<Closure> closure) {
  return std::make_shared<ScriptProcedure const>(runtime, std::move(closure), Fiber::Role::action);
}

std::shared_ptr<tasks::Procedure const> make_handler(Runtime& runtime, Ref<Closure> closure) {
  return std::make_shared<ScriptProcedure const>(runtime, std::move(closure), Fiber::Role::handler);
}

base::Task<void> drive(Runtime& runtime, Fiber& fiber) {
  while (fiber.state() == Fiber::State::ready || fiber.state() == Fiber::State::waiting) {
    if (fiber.state() == Fiber::State::waiting) {
      auto wait = fiber.take_wait();
      auto result = co_await wait;
      fiber.resume(std::move(result));
    }
    auto const began = runtime.loop.now();
    int budget = runtime.limits.slice;
    if (fiber.run(budget) == Fiber::State::ready)
      co_await runtime.loop.sleep_until(began + runtime.limits.slice * time_of_step);
  }
}

}  // namespace lapwing::dolphin
