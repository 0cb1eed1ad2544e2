#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <vector>

namespace lapwing::base::internal {

/// A function with its arguments on its way through the pool, and then what became of it. Shared by the coroutine that
/// waits for it and the thread that runs it, as either may be the last to need it.
class Work {
 public:
  Work() = default;
  Work(Work const&) = delete;
  Work& operator=(Work const&) = delete;
  virtual ~Work() = default;

  /// Once true, the thread that ran it touches it no more.
  [[nodiscard]] bool is_done() const { return is_done_; }

 protected:
  std::stop_source stop_{std::nostopstate};

 private:
  friend class Workers;
  using Queue = std::list<std::shared_ptr<Work>>;

  /// Called once, on a thread of the pool.
  virtual void run() noexcept = 0;

  std::atomic<bool> is_done_ = false;
  std::optional<Queue::iterator> place_;  // while it waits for a thread; the queue's mutex guards it
};

/// The pool's threads, and what waits for one of them in the order in which it came. Threads are started when there is
/// work for them, up to the limit. Thread-bound but for what its own threads do.
class Workers {
 public:
  /// `wake` is called on one of the threads when something is done and the loop sleeps.
  Workers(unsigned most_threads, std::function<void()> wake);
  /// Joins: waits for what runs, and begins nothing more.
  ~Workers();
  Workers(Workers const&) = delete;
  Workers& operator=(Workers const&) = delete;

  void submit(std::shared_ptr<Work> work);
  /// Nobody waits for `work` any more: it is never begun, or asked to stop if it has been.
  void abandon(Work& work);

  /// Whether the loop may go to sleep: not when `awaited` is done. From now on until `has_woken` it is woken.
  [[nodiscard]] bool may_sleep(Work const& awaited);
  void has_woken() { loop_sleeps_ = false; }

 private:
  void serve();
  std::shared_ptr<Work> next();
  void finish(Work& work);

  unsigned most_threads_;
  std::function<void()> wake_;
  std::atomic<bool> loop_sleeps_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  Work::Queue queue_;
  std::size_t idle_ = 0;  // threads that will look into the queue without being told to
  bool is_closing_ = false;
  std::vector<std::jthread> threads_;
};

/// Whether the calling thread is one of a pool's, where nothing of a loop may be touched.
[[nodiscard]] bool is_on_pool();

}  // namespace lapwing::base::internal
