#pragma once

#include <cstddef>
#include <list>
#include <memory>

#include "base/loop.hpp"
#include "base/task.hpp"

namespace lapwing::base {

/// Owns coroutines that run beside their owner; destroying the scope cancels what still runs.
///
/// A component that starts background work holds a `Scope` as its last member. Must not be destroyed or cleared from
/// within one of its own tasks: post that to the loop.
class Scope {
 public:
  explicit Scope(Loop& loop) : loop_(loop) {}
  Scope(Scope const&) = delete;
  Scope& operator=(Scope const&) = delete;

  /// Starts `task` at once, up to its first suspension.
  void spawn(Task<void> task);
  void clear() { children_->clear(); }
  [[nodiscard]] std::size_t size() const { return children_->size(); }
  [[nodiscard]] bool empty() const { return children_->empty(); }

 private:
  struct Child {
    std::weak_ptr<std::list<Child>> family;
    std::list<Child>::iterator self;
    Loop& loop;
    Task<void> task;
  };
  static void bury_later(void* child) noexcept;

  Loop& loop_;
  std::shared_ptr<std::list<Child>> children_ = std::make_shared<std::list<Child>>();
};

}  // namespace lapwing::base
