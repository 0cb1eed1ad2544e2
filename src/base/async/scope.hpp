#pragma once

#include <cstddef>
#include <list>
#include <memory>

#include "base/async/loop.hpp"
#include "base/async/notifier.hpp"
#include "base/async/task.hpp"

namespace lapwing::base {

/// Owns coroutines that run beside their owner; destroying the scope cancels what still runs.
///
/// A component that starts background work holds a `Scope` as its last member. Must not be destroyed or cleared from
/// within one of its own tasks: post that to the loop.
class Scope {
 public:
  explicit Scope(Loop& loop) : loop_(loop), emptied_(loop) {}
  Scope(Scope const&) = delete;
  Scope& operator=(Scope const&) = delete;

  /// Starts `task` at once, up to its first suspension.
  void spawn(Task<void> task);
  /// Cancels what still runs.
  void clear();
  [[nodiscard]] std::size_t size() const { return children_->size(); }
  [[nodiscard]] bool empty() const { return children_->empty(); }

  /// Waits until every task has ended or was cancelled, also those that are spawned meanwhile. A task of this scope
  /// would wait for itself.
  [[nodiscard]] Task<> join();
  /// The same; false when `deadline` came first. What runs then goes on.
  [[nodiscard]] Task<bool> join_until(TimePoint deadline);

 private:
  struct Child;
  using Children = std::list<Child>;
  struct Child {
    Scope& scope;
    std::weak_ptr<Children> siblings;
    Children::iterator self;
    Task<void> task;
  };
  static void bury_later(void* child) noexcept;

  Loop& loop_;
  Notifier emptied_;
  // Another list after `clear()`, so that who was to be buried from the old one is not looked for.
  std::shared_ptr<Children> children_ = std::make_shared<Children>();
};

}  // namespace lapwing::base
