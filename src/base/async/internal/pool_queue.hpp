#pragma once

#include <coroutine>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <utility>

#include "base/async/internal/workers.hpp"
#include "base/async/waiter.hpp"

namespace lapwing::base::internal {

/// One coroutine that waits for work on the pool: what there is of a `PoolJob` whatever its types. Destroying it, with
/// the coroutine's frame, abandons the work.
class PoolWait {
 public:
  PoolWait(Loop& loop, std::shared_ptr<Work> work) : loop_(loop), waiter_(loop), work_(std::move(work)) {}
  PoolWait(PoolWait const&) = delete;
  PoolWait& operator=(PoolWait const&) = delete;
  ~PoolWait();

 protected:
  void submit(std::coroutine_handle<> handle);
  [[nodiscard]] Work& work() { return *work_; }

 private:
  friend class PoolQueue;

  Loop& loop_;
  Waiter waiter_;
  std::shared_ptr<Work> work_;
  std::optional<std::list<PoolWait*>::iterator> place_;  // from its submission until it is delivered
};

/// The loop's side of the pool: who waits, in the order of submission, which is that of the results.
class PoolQueue {
 public:
  /// `wake` is called on another thread; `hold_time` at once for each job, before a thread learns of it.
  PoolQueue(unsigned most_threads, std::function<void()> wake, std::function<void()> hold_time)
      : hold_time_(std::move(hold_time)), workers_(most_threads, std::move(wake)) {}

  void submit(PoolWait& wait);
  void withdraw(PoolWait& wait);

  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  [[nodiscard]] std::size_t size() const { return waiting_.size(); }
  /// Wakes whoever waits for the oldest job if it is done; false when it is not, or when there is none.
  bool deliver_oldest();
  /// False when the oldest job is done. Else whoever sleeps now is woken once it may be: call `has_woken` afterwards.
  [[nodiscard]] bool may_sleep() { return workers_.may_sleep(*waiting_.front()->work_); }
  void has_woken() { workers_.has_woken(); }

 private:
  std::function<void()> hold_time_;
  std::list<PoolWait*> waiting_;
  Workers workers_;
};

}  // namespace lapwing::base::internal
