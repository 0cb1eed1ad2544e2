#pragma once

#include <coroutine>
#include <list>
#include <map>
#include <optional>
#include <utility>

#include "base/time.hpp"

namespace lapwing::base {

class Loop;
class Waiter;

/// Waiters in the order in which they came. A waiter removes itself when it is destroyed.
using WaiterList = std::list<Waiter*>;

/// One suspended coroutine and the places from which it can be woken.
///
/// Lives in the awaiter, so in the coroutine's frame: destroying the frame takes the waiter out of every queue. That is
/// how cancelling works here: whoever owns a `Task` destroys it, and nothing can resume it any more. Thread-bound to
/// its loop.
class Waiter {
 public:
  explicit Waiter(Loop& loop) : loop_(loop) {}
  Waiter(Waiter const&) = delete;
  Waiter& operator=(Waiter const&) = delete;
  ~Waiter() { withdraw(); }

  /// Waits in `list`, to be woken by whoever owns the list.
  void join(WaiterList& list);
  /// Wakes by itself at `deadline`, and says so in `timed_out()`.
  void arm(TimePoint deadline);
  /// Puts the coroutine on the loop's ready queue; a second call does nothing.
  void wake();

  void suspend(std::coroutine_handle<> handle) { handle_ = handle; }
  [[nodiscard]] bool timed_out() const { return timed_out_; }

 private:
  friend class Loop;
  using TimerKey = std::pair<TimePoint, unsigned long long>;
  using Timers = std::map<TimerKey, Waiter*>;

  void withdraw();
  void leave_list();

  Loop& loop_;
  std::coroutine_handle<> handle_;
  WaiterList* list_ = nullptr;
  WaiterList::iterator place_;
  std::optional<Timers::iterator> timer_;
  bool ready_ = false;
  bool timed_out_ = false;
};

}  // namespace lapwing::base
