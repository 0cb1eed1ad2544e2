#include "base/async/internal/job_thread.hpp"

#include <utility>

namespace lapwing::base::internal {

JobThread::JobThread() : thread_([this] { serve(); }) {}

JobThread::~JobThread() {
  {
    std::lock_guard const lock(mutex_);
    is_closing_ = true;
  }
  changed_.notify_one();
}

void JobThread::submit(Job job) {
  {
    std::lock_guard const lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  changed_.notify_one();
}

std::size_t JobThread::waiting() const {
  std::lock_guard const lock(mutex_);
  return jobs_.size();
}

void JobThread::serve() {
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_closing_ || !jobs_.empty(); });
      if (jobs_.empty()) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    job();
  }
}

}  // namespace lapwing::base::internal
