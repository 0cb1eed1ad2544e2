#include "base/async/internal/workers.hpp"

#include <utility>

#include "base/assert.hpp"

namespace lapwing::base::internal {

namespace {

thread_local bool is_worker = false;

}  // namespace

bool is_on_pool() {
  return is_worker;
}

Workers::Workers(unsigned most_threads, std::function<void()> wake)
    : most_threads_(most_threads), wake_(std::move(wake)) {
  LAPWING_ASSERT(most_threads_ > 0);
}

Workers::~Workers() {
  {
    std::lock_guard const lock(mutex_);
    is_closing_ = true;
    queue_.clear();
  }
  changed_.notify_all();
  threads_.clear();
}

void Workers::submit(std::shared_ptr<Work> work) {
  {
    std::lock_guard const lock(mutex_);
    auto const place = queue_.insert(queue_.end(), std::move(work));
    (*place)->place_ = place;
    if (idle_ < queue_.size() && threads_.size() < most_threads_) {
      ++idle_;
      threads_.emplace_back([this] { serve(); });
    }
  }
  changed_.notify_one();
}

void Workers::abandon(Work& work) {
  std::shared_ptr<Work> dropped;  // dies outside of the lock: its arguments may have much to destroy
  {
    std::lock_guard const lock(mutex_);
    if (work.place_) {
      dropped = std::move(**work.place_);
      queue_.erase(*work.place_);
      work.place_.reset();
    }
  }
  if (!dropped) work.stop_.request_stop();
}

bool Workers::may_sleep(Work const& awaited) {
  // First said, then looked: whoever is done after the look sees that it was said.
  loop_sleeps_ = true;
  if (!awaited.is_done()) return true;
  loop_sleeps_ = false;
  return false;
}

void Workers::serve() {
  is_worker = true;
  while (auto const work = next()) {
    work->run();
    finish(*work);
  }
}

/// Null when the pool closes.
std::shared_ptr<Work> Workers::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return is_closing_ || !queue_.empty(); });
  if (is_closing_) return nullptr;
  --idle_;
  auto work = std::move(queue_.front());
  queue_.pop_front();
  work->place_.reset();
  return work;
}

void Workers::finish(Work& work) {
  {
    // Before anybody learns that it is done: what follows from it needs no other thread.
    std::lock_guard const lock(mutex_);
    ++idle_;
  }
  work.is_done_ = true;
  if (loop_sleeps_.exchange(false)) wake_();
}

}  // namespace lapwing::base::internal
