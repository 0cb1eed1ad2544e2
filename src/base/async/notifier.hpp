#pragma once

#include <coroutine>
#include <functional>
#include <utility>

#include "base/async/loop.hpp"

namespace lapwing::base {

/// A condition variable for coroutines: "something about this changed". Carries no value: look at the state after
/// waking.
class Notifier {
 public:
  explicit Notifier(Loop& loop) : loop_(loop) {}
  Notifier(Notifier const&) = delete;
  Notifier& operator=(Notifier const&) = delete;

  void notify_all() {
    while (!waiting_.empty()) waiting_.front()->wake();
  }

  /// `co_await notifier.wait_until(deadline)`: true when notified, false when the deadline came first.
  class [[nodiscard]] Wait {
   public:
    Wait(Loop& loop, WaiterList& list, TimePoint deadline) : waiter_(loop), list_(list), deadline_(deadline) {}
    [[nodiscard]] bool await_ready() const noexcept { return false; }
    void await_suspend(std::coroutine_handle<> handle) {
      waiter_.suspend(handle);
      waiter_.join(list_);
      if (deadline_ != TimePoint::max()) waiter_.arm(deadline_);
    }
    bool await_resume() const noexcept { return !waiter_.timed_out(); }

   private:
    Waiter waiter_;
    WaiterList& list_;
    TimePoint deadline_;
  };
  Wait wait_until(TimePoint deadline) { return Wait(loop_, waiting_, deadline); }
  Wait wait() { return wait_until(TimePoint::max()); }

  /// Waits until `condition()` holds, looking again after every notification; false when `timeout` passed first.
  Task<bool> wait_for(std::function<bool()> condition, Duration timeout) {
    auto const deadline = loop_.now() + timeout;
    while (!condition()) {
      if (loop_.now() >= deadline) co_return false;
      co_await wait_until(deadline);
    }
    co_return true;
  }

 private:
  Loop& loop_;
  WaiterList waiting_;
};

}  // namespace lapwing::base
