#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "host/session/stall_watch.hpp"

#include <ctime>

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

namespace lapwing::host {

struct StallWatch::Waiting : std::enable_shared_from_this<Waiting> {
  Waiting(base::Loop& on, std::chrono::seconds patience, std::function<void()> call)
      : loop(on), left(patience), whole(patience), timer(on.io()), on_stall(std::move(call)) {}

  void wait() {
    timer.expires_after(std::chrono::seconds(1));
    timer.async_wait([self = shared_from_this()](boost::system::error_code error) {
      if (!error) self->look();
    });
  }
  void look() {
    // Time also stands still while a question waits for its answer, but then nothing is busy.
    constexpr auto least_work = CLOCKS_PER_SEC / 10;
    bool const is_busy = std::clock() - worked > least_work;
    if (loop.now() != seen) left = whole;
    if (loop.now() == seen && is_busy) left -= std::chrono::seconds(1);
    seen = loop.now();
    worked = std::clock();
    if (left > std::chrono::seconds(0)) return wait();
    on_stall();
  }

  base::Loop& loop;
  std::chrono::seconds left;
  std::chrono::seconds whole;
  boost::asio::steady_timer timer;
  std::function<void()> on_stall;
  base::TimePoint seen{};
  std::clock_t worked = std::clock();
};

StallWatch::StallWatch(base::Loop& loop, std::chrono::seconds patience, std::function<void()> on_stall)
    : waiting_(std::make_shared<Waiting>(loop, patience, std::move(on_stall))) {
  waiting_->wait();
}

StallWatch::~StallWatch() {
  boost::system::error_code ignored;  // of one that does not fail, which would throw without it
  waiting_->timer.cancel(ignored);
}

}  // namespace lapwing::host
