#pragma once

#include <cstddef>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>

#include "base/async/internal/job_thread.hpp"
#include "base/async/notifier.hpp"
#include "base/async/pool.hpp"

namespace lapwing::base {

/// A thread beside the loop with a state that only it touches: a connection to a database, a library that wants to be
/// called from one thread. `auto rows = co_await side.run(job);` calls `job(state)` there, one job after the other in
/// the order of the calls, and brings back what it returns.
///
/// For pure functions there is the pool (`Loop::on_pool`), which is ordered for simulated time; time waits for what
/// runs here only where `run_in_time` says so. A job owns what it captures. Whoever awaits it may go away: what was
/// asked for is done all the same. How many jobs wait is bounded by the coroutines that await them. Thread-bound to the
/// loop, which outlives it.
template <class State>
class SideThread {
 public:
  SideThread(Loop& loop, std::unique_ptr<State> state) : loop_(loop), state_(std::move(state)) {}
  SideThread(SideThread const&) = delete;
  SideThread& operator=(SideThread const&) = delete;
  /// What was asked for is done before this returns.
  ~SideThread() = default;

  /// An exception that leaves the job ends the process.
  template <class Job>
  [[nodiscard]] Task<std::invoke_result_t<Job&, State&>> run(Job job) {
    auto const answer = std::make_shared<Answer<std::invoke_result_t<Job&, State&>>>(loop_);
    ask(std::move(job), answer);
    while (!answer->is_there) co_await answer->arrived.wait();
    co_return std::move(*answer->result);
  }
  /// The same in a run that is to repeat: the answer comes `after` later, however long it really takes. Time waits for
  /// it there if it has to, as it does for results of the pool (`Loop::on_pool`), in whose order it comes. So does the
  /// pool: at the wall's pace, where time goes on, use `run`.
  template <class Job>
  [[nodiscard]] Task<std::invoke_result_t<Job&, State&>> run_in_time(Job job, Duration after) {
    using Result = std::invoke_result_t<Job&, State&>;
    std::promise<Result> promise;
    auto answer = promise.get_future();
    thread_.submit([&state = *state_, job = std::move(job), promise = std::move(promise)]() mutable {
      promise.set_value(job(state));
    });
    if (after > Duration::zero()) co_await loop_.sleep(after);
    auto const wait = [](std::future<Result> coming) { return coming.get(); };
    co_return co_await loop_.on_pool(wait, std::move(answer));
  }
  /// The same as `run` for who wants no answer.
  template <class Job>
  void give(Job job) {
    thread_.submit([&state = *state_, job = std::move(job)]() mutable { job(state); });
  }
  [[nodiscard]] std::size_t waiting() const { return thread_.waiting(); }

 private:
  template <class Result>
  struct Answer {
    explicit Answer(Loop& loop) : arrived(loop) {}
    std::optional<Result> result;  // the thread's, until the loop has been told
    bool is_there = false;         // the loop's, like the notifier
    Notifier arrived;
  };

  template <class Job, class Result>
  void ask(Job job, std::shared_ptr<Answer<Result>> answer) {
    thread_.submit([&loop = loop_, &state = *state_, job = std::move(job), answer = std::move(answer)]() mutable {
      answer->result.emplace(job(state));
      // The thread lets go of it here: the last to hold it is the loop, whose notifier it has.
      loop.post_from_other_thread([told = std::move(answer)] {
        told->is_there = true;
        told->arrived.notify_all();
      });
    });
  }

  Loop& loop_;
  std::unique_ptr<State> state_;
  internal::JobThread thread_;  // last: it ends before its state does
};

}  // namespace lapwing::base
