#include "base/async/pool.hpp"

#include "base/assert.hpp"

namespace lapwing::base::internal {

PoolWait::~PoolWait() {
  if (place_) loop_.pool().withdraw(*this);
}

void PoolWait::submit(std::coroutine_handle<> handle) {
  LAPWING_ASSERT(!is_on_pool());
  waiter_.suspend(handle);
  loop_.pool().submit(*this);
}

void PoolQueue::submit(PoolWait& wait) {
  wait.place_ = waiting_.insert(waiting_.end(), &wait);
  hold_time_();
  workers_.submit(wait.work_);
}

void PoolQueue::withdraw(PoolWait& wait) {
  waiting_.erase(*std::exchange(wait.place_, std::nullopt));
  workers_.abandon(*wait.work_);
}

bool PoolQueue::deliver_oldest() {
  if (waiting_.empty() || !waiting_.front()->work_->is_done()) return false;
  auto& oldest = *waiting_.front();
  waiting_.pop_front();
  oldest.place_.reset();
  oldest.waiter_.wake();
  return true;
}

}  // namespace lapwing::base::internal
