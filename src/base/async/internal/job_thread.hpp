#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace lapwing::base::internal {

/// A thread that does one job after the other, in the order in which they were given.
class JobThread {
 public:
  using Job = std::move_only_function<void()>;

  JobThread();
  /// Joins: what was given before is done.
  ~JobThread();
  JobThread(JobThread const&) = delete;
  JobThread& operator=(JobThread const&) = delete;

  void submit(Job job);
  /// Those that have not begun.
  [[nodiscard]] std::size_t waiting() const;

 private:
  void serve();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Job> jobs_;
  bool is_closing_ = false;
  std::jthread thread_;  // last: it uses what stands above
};

}  // namespace lapwing::base::internal
