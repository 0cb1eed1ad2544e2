#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "host/session/signals.hpp"

#include <unistd.h>
#include <csignal>
#include <cstdio>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>

#include "host/exit_code.hpp"

namespace lapwing::host {

struct StopSignals::Waiting : std::enable_shared_from_this<Waiting> {
  Waiting(base::Loop& loop, std::function<void()> call) : set(loop.io(), SIGINT, SIGTERM), stop(std::move(call)) {}

  void wait(int count) {
    set.async_wait([self = shared_from_this(), count](boost::system::error_code error, int) {
      if (error) return;
      if (count > 0) {
        std::fputs("\nlapwing: ended at once; vehicles keep what they were told last\n", stderr);
        ::_exit(exit_interrupted);
      }
      self->stop();
      self->wait(count + 1);
    });
  }

  boost::asio::signal_set set;
  std::function<void()> stop;
};

StopSignals::StopSignals(base::Loop& loop, std::function<void()> stop)
    : waiting_(std::make_shared<Waiting>(loop, std::move(stop))) {
  waiting_->wait(0);
}

StopSignals::~StopSignals() {
  boost::system::error_code ignored;
  waiting_->set.cancel(ignored);
}

struct ReloadSignal::Waiting : std::enable_shared_from_this<Waiting> {
  Waiting(base::Loop& loop, std::function<void()> call) : set(loop.io(), SIGHUP), reload(std::move(call)) {}

  void wait() {
    set.async_wait([self = shared_from_this()](boost::system::error_code error, int) {
      if (error) return;
      self->reload();
      self->wait();
    });
  }

  boost::asio::signal_set set;
  std::function<void()> reload;
};

ReloadSignal::ReloadSignal(base::Loop& loop, std::function<void()> reload)
    : waiting_(std::make_shared<Waiting>(loop, std::move(reload))) {
  waiting_->wait();
}

ReloadSignal::~ReloadSignal() {
  boost::system::error_code ignored;
  waiting_->set.cancel(ignored);
}

}  // namespace lapwing::host
