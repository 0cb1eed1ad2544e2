#include "tasks/execution.hpp"

#include <utility>

#include "tasks/internal/executor.hpp"

namespace lapwing::tasks {

using internal::Context;

Execution::Execution(TaskTree const& tree, Allocation allocation, Platform& platform, Observer observer)
    : context_(std::make_unique<Context>(
          Context{.platform = platform, .observer = std::move(observer), .vehicles = {}, .withdrawn = {}})),
      allocation_(std::move(allocation)) {
  for (auto const& assignment : allocation_.assignments) {
    context_->vehicles.emplace(assignment.occurrence, assignment.vehicle);
  }
  int occurrence = 0;
  root_ = internal::make_executor(tree, *context_, occurrence);
}

Execution::~Execution() {
  root_->stop();
}

void Execution::start(base::TimePoint now) {
  context_->now = now;
  for (auto const& assignment : allocation_.assignments) {
    context_->report(TaskEvent::Kind::alloc, assignment.task, assignment.vehicle);
  }
  root_->start();
}

bool Execution::step(base::TimePoint now) {
  if (outcome_) return true;
  context_->now = now;
  auto const state = root_->step();
  if (state == TaskState::done) outcome_ = Outcome{};
  if (state == TaskState::failed) outcome_ = Outcome{.failure = root_->failure()};
  return outcome_.has_value();
}

void Execution::stop(base::TimePoint now) {
  if (outcome_) return;
  context_->now = now;
  root_->stop();
  outcome_ = Outcome{.is_stopped = true};
}

void Execution::withdraw(VehicleId const& vehicle) {
  context_->withdrawn.insert(vehicle);
  root_->withdraw(vehicle);
}

TaskView Execution::view() const {
  int next_id = 0;
  return root_->view(next_id);
}

base::Task<Outcome> run(base::Loop& loop, Execution& execution, base::Duration tick) {
  auto due = loop.now();
  execution.start(due);
  for (;;) {
    execution.step(due);
    auto const late = loop.now() - due;
    due += tick * (late / tick + 1);
    co_await loop.sleep_until(due);
    if (execution.outcome()) co_return *execution.outcome();
  }
}

}  // namespace lapwing::tasks
