#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "tasks/internal/executor.hpp"

namespace lapwing::tasks::internal {
namespace {

class SequenceExecutor final : public Executor {
 public:
  using Executor::Executor;

 private:
  void on_start() override { children_.front()->start(); }
  void on_step() override {
    for (;;) {
      auto const state = children_[current_]->step();
      if (state == TaskState::failed) return fail(children_[current_]->failure());
      if (state != TaskState::done) return;
      if (++current_ == children_.size()) return finish();
      children_[current_]->start();
    }
  }
  std::size_t current_ = 0;
};

class ConcurrentExecutor final : public Executor {
 public:
  using Executor::Executor;

 private:
  void on_start() override {
    for (auto const& child : children_) {
      child->start();
      if (has_thrown(*child)) return fail(child->failure());
    }
  }
  /// After a task error the parts to the right still have their turn in this tick; after an exception they have not.
  void on_step() override {
    for (auto const& child : children_) {
      child->step();
      if (has_thrown(*child)) return fail(child->failure());
    }
    auto const failed = std::ranges::find(children_, TaskState::failed, state_of);
    if (failed != children_.end()) return fail((*failed)->failure());
    auto const is_done = [](TaskState state) { return state == TaskState::done; };
    if (std::ranges::all_of(children_, is_done, state_of)) finish();
  }
  static TaskState state_of(std::unique_ptr<Executor> const& child) { return child->state(); }
  static bool has_thrown(Executor const& child) {
    return child.state() == TaskState::failed && child.failure().kind != FailureKind::task;
  }
};

class UntilExecutor final : public Executor {
 public:
  UntilExecutor(Context& context, TaskTree task, Guard const& guard)
      : Executor(context, std::move(task), "until"), guard_(guard) {}

 private:
  void on_start() override {
    auto const met = holds(guard_);
    if (!met) return;
    if (*met) return finish();
    children_.front()->start();
    is_tested_ = true;
  }
  void on_step() override {
    // Once a tick, because testing may have side effects; the start did it for the first one.
    if (!std::exchange(is_tested_, false)) {
      auto const met = holds(guard_);
      if (!met) return;
      if (*met) return finish();
    }
    children_.front()->step();
    end_like(*children_.front());
  }
  Guard const& guard_;
  bool is_tested_ = false;
};

class DuringExecutor final : public Executor {
 public:
  DuringExecutor(Context& context, TaskTree task, base::Duration limit)
      : Executor(context, std::move(task), "during"), limit_(limit) {}

 private:
  void on_start() override {
    if (limit_ <= base::Duration::zero()) return finish();
    children_.front()->start();
  }
  void on_step() override {
    if (elapsed() >= limit_) return finish();
    children_.front()->step();
    end_like(*children_.front());
  }
  base::Duration limit_;
};

class ChoiceExecutor final : public Executor {
 public:
  ChoiceExecutor(Context& context, TaskTree task, std::vector<Branch> const& branches)
      : Executor(context, std::move(task), branches.size() == 1 ? "waitFor" : "choice"), branches_(branches) {}

 private:
  void on_step() override {
    if (!chosen_) choose();
    if (!chosen_) return;
    chosen_->step();
    end_like(*chosen_);
  }
  void choose() {
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      auto const met = holds(*branches_[i].when);
      if (!met) return;
      if (!*met) continue;
      chosen_ = children_[i].get();
      return chosen_->start();
    }
  }
  std::vector<Branch> const& branches_;
  Executor* chosen_ = nullptr;
};

class AllOfExecutor final : public Executor {
 public:
  AllOfExecutor(Context& context, TaskTree task, std::vector<Branch> const& branches)
      : Executor(context, std::move(task), "allOf"), branches_(branches) {}

 private:
  void on_start() override {
    if (branches_.empty()) finish();
  }
  void on_step() override {
    if (!current_) choose();
    if (!current_) return;
    current_->step();
    if (current_->state() == TaskState::failed) return fail(current_->failure());
    if (current_->state() != TaskState::done) return;
    current_ = nullptr;  // the guards of the rest are next tested a tick later
    if (++ended_ == branches_.size()) finish();
  }
  void choose() {
    for (std::size_t i = 0; i < branches_.size(); ++i) {
      if (children_[i]->state() != TaskState::waiting) continue;
      auto const met = holds(*branches_[i].when);
      if (!met) return;
      if (!*met) continue;
      current_ = children_[i].get();
      return current_->start();
    }
  }
  std::vector<Branch> const& branches_;
  Executor* current_ = nullptr;
  std::size_t ended_ = 0;
};

class WatchExecutor final : public Executor {
 public:
  WatchExecutor(Context& context, TaskTree task, Procedure const& handler)
      : Executor(context, std::move(task), "watch"), handler_(handler) {}

 private:
  void on_start() override { children_.front()->start(); }
  void on_step() override {
    if (!call_) {
      auto const& body = *children_.front();
      children_.front()->step();
      if (body.state() != TaskState::failed || body.failure().kind == FailureKind::halt) return end_like(body);
      call_ = handler_.begin(body.failure());
    }
    handle();
  }
  void handle() {
    auto state = call_->step();
    if (!state) return fail(std::move(state.error()));
    if (*state == CallState::suspended) return;
    if (call_->verdict() == Verdict::ignore) return finish();
    auto failure = children_.front()->failure();
    failure.kind = FailureKind::task;  // an exception within a watched task is that task's error (REC-37b)
    fail(std::move(failure));
  }
  void on_end() override { call_.reset(); }

  Procedure const& handler_;
  std::unique_ptr<Call> call_;
};

class ActionExecutor final : public Executor {
 public:
  ActionExecutor(Context& context, TaskTree task, Procedure const& body)
      : Executor(context, std::move(task), "action"), body_(body) {}

 private:
  void on_step() override {
    if (!call_) call_ = body_.begin(std::nullopt);
    auto state = call_->step();
    if (!state) return fail(std::move(state.error()));
    if (*state == CallState::returned) finish();
  }
  void on_end() override { call_.reset(); }

  Procedure const& body_;
  std::unique_ptr<Call> call_;
};

class ConditionExecutor final : public Executor {
 public:
  ConditionExecutor(Context& context, TaskTree task, Guard const& guard)
      : Executor(context, std::move(task), "condition"), guard_(guard) {}

 private:
  void on_step() override {
    if (holds(guard_).value_or(false)) finish();
  }
  Guard const& guard_;
};

class IdleExecutor final : public Executor {
 public:
  IdleExecutor(Context& context, TaskTree task, std::optional<base::Duration> length)
      : Executor(context, std::move(task), "idle"), length_(length) {}

 private:
  void on_step() override {
    if (length_ && elapsed() >= *length_) finish();
  }
  std::optional<base::Duration> length_;
};

class PerformedExecutor final : public Executor {
 public:
  PerformedExecutor(Context& context, TaskTree task, std::shared_ptr<PlatformTask const> subject, VehicleId vehicle)
      : Executor(context, std::move(task), subject->kind()),
        subject_(std::move(subject)),
        vehicle_(std::move(vehicle)) {}

  void withdraw(VehicleId const& vehicle) override {
    if (vehicle != vehicle_ || state() != TaskState::running) return;
    end_run();
    fail_with(withdrawn_text(), false);
  }

 private:
  void on_start() override {
    if (context_.withdrawn.contains(vehicle_)) return report_failure(withdrawn_text(), false);
    context_.report(TaskEvent::Kind::start, subject_, vehicle_);
    run_ = context_.platform.start(subject_, vehicle_);
  }
  void on_step() override {
    switch (run_->state()) {
      case RunState::in_progress: return;
      case RunState::done:
        run_.reset();
        context_.report(TaskEvent::Kind::done, subject_, vehicle_);
        return finish();
      case RunState::failed:
        auto const run = std::exchange(run_, nullptr);
        return report_failure(run->error(), run->vehicle_failed());
    }
  }
  void on_end() override { end_run(); }
  void describe(TaskView& view) const override {
    view.vehicle = vehicle_;
    if (run_) view.detail = run_->progress();
  }

  /// Ends what is under way; nothing when it has ended by itself.
  void end_run() {
    if (!run_) return;
    auto const run = std::exchange(run_, nullptr);
    context_.report(TaskEvent::Kind::stop, subject_, vehicle_);
    run->stop();
  }
  void report_failure(std::string const& why, bool vehicle_failed) {
    context_.report(TaskEvent::Kind::error, subject_, vehicle_, why);
    fail_with(why, vehicle_failed);
  }
  void fail_with(std::string why, bool vehicle_failed) {
    fail({.message = std::move(why),
          .culprit = fmt::format("{} on {}", subject_->name(), vehicle_.text),
          .vehicle_failed = vehicle_failed});
  }
  [[nodiscard]] std::string withdrawn_text() const { return fmt::format("vehicle {} was released", vehicle_.text); }

  std::shared_ptr<PlatformTask const> subject_;
  VehicleId vehicle_;
  std::unique_ptr<TaskRun> run_;
};

/// Picks the executor of each kind of task.
struct Maker {
  TaskTree const& task;
  Context& context;
  int& occurrence;

  using Made = std::unique_ptr<Executor>;
  Made operator()(Sequence const&) const { return std::make_unique<SequenceExecutor>(context, task, "sequence"); }
  Made operator()(Concurrent const&) const { return std::make_unique<ConcurrentExecutor>(context, task, "concurrent"); }
  Made operator()(Until const& kind) const { return std::make_unique<UntilExecutor>(context, task, *kind.guard); }
  Made operator()(During const& kind) const { return std::make_unique<DuringExecutor>(context, task, kind.limit); }
  Made operator()(Choice const& kind) const { return std::make_unique<ChoiceExecutor>(context, task, kind.branches); }
  Made operator()(AllOf const& kind) const { return std::make_unique<AllOfExecutor>(context, task, kind.branches); }
  Made operator()(Watch const& kind) const { return std::make_unique<WatchExecutor>(context, task, *kind.on_error); }
  Made operator()(Action const& kind) const { return std::make_unique<ActionExecutor>(context, task, *kind.body); }
  Made operator()(Condition const& kind) const {
    return std::make_unique<ConditionExecutor>(context, task, *kind.guard);
  }
  Made operator()(Idle const& kind) const { return std::make_unique<IdleExecutor>(context, task, kind.length); }
  /// Restrictions only matter to the allocation.
  Made operator()(Restricted const& kind) const { return make_executor(kind.body, context, occurrence); }
  Made operator()(Performed const& kind) const {
    return std::make_unique<PerformedExecutor>(context, task, kind.task, context.vehicles.at(occurrence++));
  }
};

/// The tasks below `kind` that get executors of their own.
std::vector<TaskTree> bodies(TaskKind const& kind) {
  auto const of_kind = []<class Kind>(Kind const& value) -> std::vector<TaskTree> {
    if constexpr (requires { value.parts; }) {
      return value.parts;
    } else if constexpr (requires { value.branches; }) {
      std::vector<TaskTree> tasks;
      for (auto const& branch : value.branches) tasks.push_back(branch.then);
      return tasks;
    } else if constexpr (std::is_same_v<Kind, Until> || std::is_same_v<Kind, During> || std::is_same_v<Kind, Watch>) {
      return {value.body};
    } else {
      return {};
    }
  };
  return std::visit(of_kind, kind);
}

}  // namespace

std::unique_ptr<Executor> make_executor(TaskTree const& task, Context& context, int& occurrence) {
  auto executor = std::visit(Maker{task, context, occurrence}, task->kind);
  for (auto const& body : bodies(task->kind)) {
    executor->children_.push_back(make_executor(body, context, occurrence));
  }
  return executor;
}

}  // namespace lapwing::tasks::internal
