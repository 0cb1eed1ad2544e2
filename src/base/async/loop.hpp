#pragma once

#include <coroutine>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>

#include "base/async/task.hpp"
#include "base/async/waiter.hpp"
#include "base/time.hpp"

namespace boost::asio {
class io_context;
}

namespace lapwing::base {

template <class F, class... Args>
class PoolJob;
namespace internal {
class PoolQueue;
class PoolWait;
}  // namespace internal

/// The event loop: one a process, on one thread, owner of all mutable state's turns.
///
/// Resumes ready coroutines, runs posted functions, serves sockets (Boost Asio's `io()`) and keeps the time of
/// everything that runs on it. Nothing here is thread-safe except `post_from_other_thread`.
class Loop {
 public:
  /// How loop time follows wall time. 1 is real time, 10 ten times faster; `unpaced` jumps to the next timer whenever
  /// nothing else is ready, so that simulated hours pass as fast as the machine computes them.
  struct Pace {
    double speedup = 1.0;
    bool unpaced = false;
    std::optional<UtcTime> begins_at =
        std::nullopt;  ///< what `utc_now` tells at the start, for runs that repeat exactly
  };

  Loop() : Loop(Pace{}) {}
  /// `pool_threads` is how many threads there may be beside the loop's for `on_pool`; they are started when needed.
  explicit Loop(Pace pace, unsigned pool_threads = one_less_than_cores());
  ~Loop();
  Loop(Loop const&) = delete;
  Loop& operator=(Loop const&) = delete;

  [[nodiscard]] TimePoint now() const;
  /// UTC that belongs to `now()`: wall time at the loop's start (or `Pace::begins_at`) plus loop time. For file stamps
  /// and people.
  [[nodiscard]] UtcTime utc_now() const;

  /// Runs `function` on a later turn, in the order of the calls.
  void post(std::function<void()> function);
  /// The same, from any thread.
  void post_from_other_thread(std::function<void()> function);

  /// `co_await loop.on_pool(function, args...)`: what the pure function returns, worked out on another thread.
  /// base/pool.hpp has it, and says how.
  template <class F, class... Args>
  [[nodiscard]] PoolJob<F, std::decay_t<Args>...> on_pool(F function, Args&&... args);
  /// How many jobs have been submitted whose results have not come.
  [[nodiscard]] std::size_t jobs_on_pool() const;
  /// As many threads as the machine has cores beside the one that the loop takes; at least one.
  [[nodiscard]] static unsigned one_less_than_cores();

  /// `co_await loop.sleep(d)`: at least one turn, then not before `d` has passed.
  class Sleep;
  [[nodiscard]] Sleep sleep(Duration duration);
  [[nodiscard]] Sleep sleep_until(TimePoint deadline);
  /// `co_await loop.turn()`: lets everything else that is ready run first.
  [[nodiscard]] Sleep turn();

  /// Serves until `stop()`.
  void run();
  /// Serves until `task` has ended and returns its result.
  template <class T>
  T run_until_done(Task<T> task);
  void stop() { stopped_ = true; }

  [[nodiscard]] boost::asio::io_context& io();

 private:
  friend class Waiter;
  friend class internal::PoolWait;

  bool run_ready();
  bool fire_timers();
  void wait_for_something();
  void wait_for_events();
  [[nodiscard]] internal::PoolQueue& pool();

  struct Io;
  std::unique_ptr<Io> io_;
  Pace pace_;
  std::chrono::steady_clock::time_point started_;
  UtcTime started_utc_;
  TimePoint unpaced_now_{};
  WaiterList ready_;
  std::list<std::function<void()>> posted_;
  Waiter::Timers timers_;
  unsigned long long timer_sequence_ = 0;
  bool stopped_ = false;
  unsigned pool_threads_;
  std::unique_ptr<internal::PoolQueue> pool_;  // from the first job on; its threads post to what stands above
};

class [[nodiscard]] Loop::Sleep {
 public:
  Sleep(Loop& loop, TimePoint deadline) : waiter_(loop), deadline_(deadline) {}
  [[nodiscard]] bool await_ready() const noexcept { return false; }
  void await_suspend(std::coroutine_handle<> handle) {
    waiter_.suspend(handle);
    waiter_.arm(deadline_);
  }
  void await_resume() const noexcept {}

 private:
  Waiter waiter_;
  TimePoint deadline_;
};

inline Loop::Sleep Loop::sleep_until(TimePoint deadline) {
  return Sleep(*this, deadline);
}
inline Loop::Sleep Loop::sleep(Duration duration) {
  return Sleep(*this, now() + duration);
}
inline Loop::Sleep Loop::turn() {
  return Sleep(*this, now());
}

template <class T>
T Loop::run_until_done(Task<T> task) {
  task.start();
  while (!task.done()) {
    if (run_ready() || fire_timers()) continue;
    wait_for_something();
  }
  return task.take();
}

}  // namespace lapwing::base
