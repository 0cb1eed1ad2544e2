#include "tasks/internal/executor.hpp"

#include <utility>

namespace lapwing::tasks::internal {

void Context::report(TaskEvent::Kind kind, std::shared_ptr<PlatformTask const> const& task, VehicleId const& vehicle,
                     std::string detail) const {
  if (!observer) return;
  observer({.time = now,
            .kind = kind,
            .task = task->name(),
            .vehicle = vehicle,
            .detail = std::move(detail),
            .subject = task});
}

void Executor::start() {
  state_ = TaskState::running;
  started_ = context_.now;
  on_start();
}

TaskState Executor::step() {
  if (state_ == TaskState::running) on_step();
  return state_;
}

void Executor::stop() {
  if (state_ == TaskState::running) end(TaskState::stopped);
}

void Executor::withdraw(VehicleId const& vehicle) {
  for (auto const& child : children_) child->withdraw(vehicle);
}

void Executor::finish() {
  end(TaskState::done);
}

void Executor::fail(Failure failure) {
  failure_ = std::move(failure);
  end(TaskState::failed);
}

void Executor::end(TaskState state) {
  state_ = state;
  for (auto const& child : children_) child->stop();
  on_end();
}

void Executor::end_like(Executor const& child) {
  if (child.state() == TaskState::done) finish();
  if (child.state() == TaskState::failed) fail(child.failure());
}

std::optional<bool> Executor::holds(Guard const& guard) {
  auto result = guard.test();
  if (result) return *result;
  fail(std::move(result.error()));
  return std::nullopt;
}

TaskView Executor::view(int& next_id) const {
  TaskView view{.id = next_id++,
                .kind = kind_,
                .label = task_->origin.label.empty() ? name(task_) : task_->origin.label,
                .line = task_->origin.line,
                .state = state_,
                .vehicle = std::nullopt,
                .detail = failure_ ? failure_->message : std::string(),
                .children = {}};
  describe(view);
  for (auto const& child : children_) view.children.push_back(child->view(next_id));
  return view;
}

}  // namespace lapwing::tasks::internal
