#pragma once

#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <boost/asio/io_context.hpp>
#include <boost/asio/steady_timer.hpp>

#include "base/async/task.hpp"
#include "station/http/http.hpp"

namespace lapwing::station::internal {

/// An answer that takes its time: the work, and what wakes the connection at its end.
struct PendingAnswer {
  PendingAnswer(boost::asio::io_context& io, base::Task<HttpResponse> task)
      : work(std::move(task)), ended(io, boost::asio::steady_timer::time_point::max()) {}

  /// For `Task::on_end`, with the answer as its context.
  static void wake(void* pending) noexcept {
    boost::system::error_code ignored;
    static_cast<PendingAnswer*>(pending)->ended.cancel(ignored);
  }

  base::Task<HttpResponse> work;
  boost::asio::steady_timer ended;
};

}  // namespace lapwing::station::internal
