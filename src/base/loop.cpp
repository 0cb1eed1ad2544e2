#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "base/loop.hpp"

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

namespace lapwing::base {

namespace asio = boost::asio;
using std::chrono::steady_clock;

struct Loop::Io {
  asio::io_context context{1};
  // Without it the context would stop for good the first time that no socket waits.
  asio::executor_work_guard<asio::io_context::executor_type> work{context.get_executor()};
};

Loop::Loop(Pace pace)
    : io_(std::make_unique<Io>()),
      pace_(pace),
      started_(steady_clock::now()),
      started_utc_(pace.begins_at.value_or(std::chrono::system_clock::now())) {}

Loop::~Loop() = default;

asio::io_context& Loop::io() {
  return io_->context;
}

TimePoint Loop::now() const {
  if (pace_.unpaced) return unpaced_now_;
  auto const elapsed = std::chrono::duration<double>(steady_clock::now() - started_).count();
  return TimePoint(from_seconds(elapsed * pace_.speedup));
}

UtcTime Loop::utc_now() const {
  return started_utc_ + std::chrono::duration_cast<UtcTime::duration>(now().time_since_epoch());
}

void Loop::post(std::function<void()> function) {
  posted_.push_back(std::move(function));
}

void Loop::post_from_other_thread(std::function<void()> function) {
  asio::post(io_->context, std::move(function));
}

void Loop::run() {
  stopped_ = false;
  while (!stopped_) {
    if (run_ready() || fire_timers()) continue;
    wait_for_something();
  }
}

/// Runs what was ready when the turn began; what becomes ready meanwhile waits for the next turn, so nothing starves
/// sockets. Of those, one has its turn: one that always has something must not starve the rest.
bool Loop::run_ready() {
  auto functions = std::exchange(posted_, {});
  auto coroutines = ready_.size();
  bool const any = !functions.empty() || coroutines > 0;
  for (auto& function : functions) function();
  // A resumed coroutine may destroy others that are in the queue, so the front is asked for anew each time.
  for (; coroutines > 0 && !ready_.empty(); --coroutines) {
    Waiter* waiter = ready_.front();
    waiter->withdraw();
    waiter->handle_.resume();
  }
  if (any) io_->context.poll_one();
  return any;
}

bool Loop::fire_timers() {
  auto const time = now();
  bool any = false;
  while (!timers_.empty() && timers_.begin()->first.first <= time) {
    Waiter* waiter = timers_.begin()->second;
    waiter->timed_out_ = true;
    waiter->wake();
    any = true;
  }
  return any;
}

void Loop::wait_for_something() {
  if (pace_.unpaced && io_->context.poll() > 0) return;
  if (timers_.empty()) {
    io_->context.run_one();
    return;
  }
  auto const next = timers_.begin()->first.first;
  if (pace_.unpaced) {
    // Sockets had their turn and had nothing: no event can come before the next timer.
    unpaced_now_ = next;
    return;
  }
  auto const wall = std::chrono::duration<double>(to_seconds(next.time_since_epoch()) / pace_.speedup);
  io_->context.run_one_until(started_ + std::chrono::ceil<steady_clock::duration>(wall));
}

void Waiter::join(WaiterList& list) {
  list_ = &list;
  place_ = list.insert(list.end(), this);
}

void Waiter::arm(TimePoint deadline) {
  timer_ = loop_.timers_.emplace(TimerKey{deadline, loop_.timer_sequence_++}, this).first;
}

void Waiter::wake() {
  if (ready_) return;
  withdraw();
  join(loop_.ready_);
  ready_ = true;
}

void Waiter::leave_list() {
  if (!list_) return;
  list_->erase(place_);
  list_ = nullptr;
}

void Waiter::withdraw() {
  leave_list();
  ready_ = false;
  if (timer_) {
    loop_.timers_.erase(*timer_);
    timer_.reset();
  }
}

}  // namespace lapwing::base
