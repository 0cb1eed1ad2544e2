#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tasks/execution.hpp"
#include "tasks/harness_platform.hpp"

/// What tests need to write task trees as a script would: closures made of C++ functions, and one `execute` on the
/// conformance platform in virtual time.
namespace lapwing::tasks::testing {

inline Failure thrown(std::string message) {
  return {.kind = FailureKind::exception, .message = std::move(message)};
}
inline Failure halted(std::string message) {
  return {.kind = FailureKind::halt, .message = std::move(message)};
}

class LambdaGuard final : public Guard {
 public:
  using Test = std::function<std::expected<bool, Failure>()>;
  explicit LambdaGuard(Test test) : test_(std::move(test)) {}
  [[nodiscard]] std::expected<bool, Failure> test() const override { return test_(); }

 private:
  Test test_;
};

inline std::shared_ptr<Guard const> when(LambdaGuard::Test test) {
  return std::make_shared<LambdaGuard const>(std::move(test));
}
inline std::shared_ptr<Guard const> always() {
  return when([] { return true; });
}
inline std::shared_ptr<Guard const> never() {
  return when([] { return false; });
}

/// A body that is `body(cause)` in the step number `returns_in_step`, and suspends in those before.
struct Body {
  std::function<std::expected<Verdict, Failure>(std::optional<Failure> const&)> run;
  int returns_in_step = 1;
  int* cancelled = nullptr;  ///< counts calls destroyed before they returned
};

class LambdaCall final : public Call {
 public:
  LambdaCall(Body body, std::optional<Failure> cause) : body_(std::move(body)), cause_(std::move(cause)) {}
  ~LambdaCall() override {
    if (body_.cancelled && !has_ended_) ++*body_.cancelled;
  }
  [[nodiscard]] std::expected<CallState, Failure> step() override {
    EXPECT_FALSE(has_ended_) << "stepped after its end";
    if (++steps_ < body_.returns_in_step) return CallState::suspended;
    has_ended_ = true;
    auto const verdict = body_.run(cause_);
    if (!verdict) return std::unexpected(verdict.error());
    verdict_ = *verdict;
    return CallState::returned;
  }
  [[nodiscard]] Verdict verdict() const override { return verdict_; }

 private:
  Body body_;
  std::optional<Failure> cause_;
  int steps_ = 0;
  bool has_ended_ = false;
  Verdict verdict_ = Verdict::propagate;
};

class LambdaProcedure final : public Procedure {
 public:
  explicit LambdaProcedure(Body body) : body_(std::move(body)) {}
  [[nodiscard]] std::unique_ptr<Call> begin(std::optional<Failure> cause) const override {
    return std::make_unique<LambdaCall>(body_, std::move(cause));
  }

 private:
  Body body_;
};

inline std::shared_ptr<Procedure const> procedure(Body body) {
  return std::make_shared<LambdaProcedure const>(std::move(body));
}
/// An action that cannot fail.
inline TaskTree doing(std::function<void()> what) {
  return action(procedure({.run = [what = std::move(what)](auto const&) -> std::expected<Verdict, Failure> {
    what();
    return Verdict::propagate;
  }}));
}
inline TaskTree throwing(Failure failure) {
  return action(procedure({.run = [failure = std::move(failure)](auto const&) -> std::expected<Verdict, Failure> {
    return std::unexpected(failure);
  }}));
}

inline base::Duration seconds(double value) {
  return base::from_seconds(value);
}

/// One loop, one conformance platform, and what happened there.
template <class Harness = HarnessPlatform>
struct BasicStage {
  base::Loop loop{{.speedup = 1.0, .unpaced = true}};
  Harness platform{loop};
  std::vector<std::string> trace;  ///< "0.3 START A@a1"

  /// `task('A:0.3')`
  TaskTree task(std::string_view name) { return performed(*platform.named_task(name)); }

  std::vector<VehicleInfo> pick(std::vector<std::string> const& ids) {
    std::vector<VehicleInfo> vehicles;
    for (auto const& id : ids) vehicles.push_back(*platform.find({id}));
    return vehicles;
  }

  Execution::Observer observer() {
    return [this](TaskEvent const& event) {
      auto const t = base::to_seconds(event.time.time_since_epoch());
      auto const detail = event.detail.empty() ? "" : " " + event.detail;
      if (event.kind == TaskEvent::Kind::alloc) return;
      trace.push_back(
          fmt::format("{:.1f} {} {}@{}{}", t, to_string(event.kind), event.task, event.vehicle->text, detail));
    };
  }

  /// `execute tree` with these vehicles picked.
  Outcome execute(TaskTree const& tree, std::vector<std::string> const& ids) {
    auto const allocation = allocate(tree, pick(ids));
    EXPECT_TRUE(allocation.has_value()) << allocation.error().message;
    Execution execution(tree, *allocation, platform, observer());
    return loop.run_until_done(run(loop, execution));
  }
  double now_s() const { return base::to_seconds(loop.now().time_since_epoch()); }
};

using Stage = BasicStage<>;
using Trace = std::vector<std::string>;

}  // namespace lapwing::tasks::testing
