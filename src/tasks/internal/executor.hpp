#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tasks/execution.hpp"

namespace lapwing::tasks::internal {

/// What all executors of one execution share.
struct Context {
  Platform& platform;
  Execution::Observer observer;
  std::map<int, VehicleId> vehicles;  ///< by occurrence of platform task
  std::set<VehicleId> withdrawn;
  base::TimePoint now{};

  void report(TaskEvent::Kind kind, std::shared_ptr<PlatformTask const> const& task, VehicleId const& vehicle,
              std::string detail = {}) const;
};

/// One occurrence of a task on its way: waiting -> running -> done | failed | stopped, each step at most once.
///
/// The base keeps the life cycle and the children; kinds say what starting and stepping mean. Whatever way an executor
/// ends, those of its children that still run are stopped.
class Executor {
 public:
  Executor(Context& context, TaskTree task, std::string kind)
      : context_(context), task_(std::move(task)), kind_(std::move(kind)) {}
  virtual ~Executor() = default;
  Executor(Executor const&) = delete;
  Executor& operator=(Executor const&) = delete;

  /// Once. May already end it.
  void start();
  /// Does nothing unless running; returns the state after it.
  TaskState step();
  /// Does nothing unless running.
  void stop();
  virtual void withdraw(VehicleId const& vehicle);

  [[nodiscard]] TaskState state() const { return state_; }
  /// Valid when failed.
  [[nodiscard]] Failure const& failure() const { return *failure_; }
  /// `next_id` numbers the nodes depth first.
  [[nodiscard]] TaskView view(int& next_id) const;

 protected:
  virtual void on_start() {}
  virtual void on_step() = 0;
  /// The executor has just ended, in whatever way.
  virtual void on_end() {}
  virtual void describe(TaskView& view) const { (void)view; }

  void finish();
  void fail(Failure failure);
  /// Ends as the child has ended, if it has.
  void end_like(Executor const& child);
  /// Nothing when the guard failed, and then so has this executor.
  [[nodiscard]] std::optional<bool> holds(Guard const& guard);
  [[nodiscard]] base::Duration elapsed() const { return context_.now - started_; }

  Context& context_;
  TaskTree task_;
  std::vector<std::unique_ptr<Executor>> children_;

 private:
  friend std::unique_ptr<Executor> make_executor(TaskTree const&, Context&, int&);
  void end(TaskState state);

  std::string kind_;
  TaskState state_ = TaskState::waiting;
  base::TimePoint started_{};
  std::optional<Failure> failure_;
};

/// The executors of a whole tree. `occurrence` counts its platform tasks.
[[nodiscard]] std::unique_ptr<Executor> make_executor(TaskTree const& task, Context& context, int& occurrence);

}  // namespace lapwing::tasks::internal
