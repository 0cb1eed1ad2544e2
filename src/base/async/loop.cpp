#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "base/async/loop.hpp"

#include <algorithm>
#include <thread>

#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include "base/assert.hpp"
#include "base/async/internal/pool_queue.hpp"

namespace lapwing::base {

namespace asio = boost::asio;
using namespace std::chrono_literals;
using std::chrono::steady_clock;

namespace {

/// How far time that waits may pass a timer: less than any period of simulation, so that nobody is a whole one late.
constexpr Duration moment = 20ms;
/// What time that waits falls behind the wall by is made up for if it is no more than this, by the wall's clock.
constexpr steady_clock::duration longest_debt = 250ms;
/// How long sockets may keep time waiting in one turn, by the wall's clock.
constexpr steady_clock::duration longest_service = 20ms;

steady_clock::duration on_the_wall(Duration loop_time, double speedup) {
  return std::chrono::ceil<steady_clock::duration>(std::chrono::duration<double>(to_seconds(loop_time) / speedup));
}

}  // namespace

struct Loop::Io {
  [[nodiscard]] static bool time_waits(Loop const& loop) { return !loop.pace_.unpaced && loop.pace_.speedup != 1.0; }
  [[nodiscard]] static TimePoint paced_now(Loop const& loop);
  void hold_time(Loop& loop);
  void serve(Loop const& loop, steady_clock::duration ran);
  [[nodiscard]] TimePoint horizon(Loop const& loop) const;

  asio::io_context context{1};
  // Without it the context would stop for good the first time that no socket waits.
  asio::executor_work_guard<asio::io_context::executor_type> work{context.get_executor()};
  TimePoint time_limit = TimePoint::max();  ///< how far time may go before the next turn
};

TimePoint Loop::Io::paced_now(Loop const& loop) {
  auto const elapsed = std::chrono::duration<double>(steady_clock::now() - loop.started_).count();
  return TimePoint(from_seconds(elapsed * loop.pace_.speedup));
}

/// Where time waits: sets how far it may go in this turn, and forgets what it could not keep up with.
void Loop::Io::hold_time(Loop& loop) {
  if (!time_waits(loop)) return;
  auto const paced = paced_now(loop);
  auto const time = std::min(paced, time_limit);
  bool const has_work = !loop.ready_.empty() || !loop.posted_.empty() || loop.jobs_on_pool() > 0;
  auto const& timers = loop.timers_;
  auto const waited_for = has_work ? time : timers.empty() ? TimePoint::max() : timers.begin()->first.first;
  auto const limit = waited_for < TimePoint::max() - moment ? waited_for + moment : TimePoint::max();
  // What was woken is waited for where the timer that woke it was.
  time_limit = std::max(time, has_work ? std::min(limit, time_limit) : limit);
  if (paced <= time_limit) return;
  auto const debt = on_the_wall(paced - time_limit, loop.pace_.speedup);
  if (debt > longest_debt) loop.started_ += debt - longest_debt;
}

/// Sockets and signals get as long as what was ready took, and one of them has its turn in any case: neither can starve
/// the other, however late timers are and however much comes in. Where time waits it does so for them, too.
void Loop::Io::serve(Loop const& loop, steady_clock::duration ran) {
  // Without a pace time waits anyway until they have nothing more, and a run must repeat whatever the wall's clock
  // says.
  if (loop.pace_.unpaced) {
    context.poll_one();
    return;
  }
  auto const end = steady_clock::now() + (time_waits(loop) ? std::max(ran, longest_service) : ran);
  while (context.poll_one() > 0 && steady_clock::now() < end) {
  }
}

/// How far time goes by itself: where it waits for a job, no further than it has been let go.
TimePoint Loop::Io::horizon(Loop const& loop) const {
  if (loop.jobs_on_pool() == 0) return TimePoint::max();
  return loop.pace_.unpaced ? loop.unpaced_now_ : time_limit;
}

Loop::Loop(Pace pace, unsigned pool_threads)
    : io_(std::make_unique<Io>()),
      pace_(pace),
      started_(steady_clock::now()),
      started_utc_(pace.begins_at.value_or(std::chrono::system_clock::now())),
      pool_threads_(pool_threads) {}

Loop::~Loop() = default;

unsigned Loop::one_less_than_cores() {
  return std::max(2U, std::thread::hardware_concurrency()) - 1;
}

internal::PoolQueue& Loop::pool() {
  if (!pool_)
    pool_ = std::make_unique<internal::PoolQueue>(
        pool_threads_, [this] { post_from_other_thread([] {}); }, [this] { io_->hold_time(*this); });
  return *pool_;
}

std::size_t Loop::jobs_on_pool() const {
  return pool_ ? pool_->size() : 0;
}

asio::io_context& Loop::io() {
  return io_->context;
}

TimePoint Loop::now() const {
  if (pace_.unpaced) return unpaced_now_;
  return std::min(Io::paced_now(*this), io_->time_limit);
}

UtcTime Loop::utc_now() const {
  return started_utc_ + std::chrono::duration_cast<UtcTime::duration>(now().time_since_epoch());
}

void Loop::post(std::function<void()> function) {
  LAPWING_ASSERT(!internal::is_on_pool());
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
/// sockets.
bool Loop::run_ready() {
  // Without a pace results come when nothing else is left to do (`wait_for_something`).
  while (!pace_.unpaced && pool_ && pool_->deliver_oldest()) {
  }
  io_->hold_time(*this);
  // Without a pace nobody asks how long it took, and the clock is a quarter of what such a turn costs.
  auto const wall = [this] { return pace_.unpaced ? steady_clock::time_point() : steady_clock::now(); };
  auto const began = wall();
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
  if (any) io_->serve(*this, wall() - began);
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
  if (!pool_ || pool_->empty()) return wait_for_events();
  // One result at a time, and all that follows from it before the next: so it does not matter which were done by now.
  if (pool_->deliver_oldest() || !pool_->may_sleep()) return;
  wait_for_events();
  pool_->has_woken();
}

void Loop::wait_for_events() {
  auto const next = timers_.empty() ? TimePoint::max() : timers_.begin()->first.first;
  if (timers_.empty() || next > io_->horizon(*this)) {
    io_->context.run_one();
    return;
  }
  if (pace_.unpaced) {
    // Sockets had their turn and had nothing: no event can come before the next timer.
    unpaced_now_ = next;
    return;
  }
  io_->context.run_one_until(started_ + on_the_wall(next.time_since_epoch(), pace_.speedup));
}

void Waiter::join(WaiterList& list) {
  list_ = &list;
  place_ = list.insert(list.end(), this);
}

void Waiter::arm(TimePoint deadline) {
  timer_ = loop_.timers_.emplace(TimerKey{deadline, loop_.timer_sequence_++}, this).first;
}

void Waiter::wake() {
  LAPWING_ASSERT(!internal::is_on_pool());
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
