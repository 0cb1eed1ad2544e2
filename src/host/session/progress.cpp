#include "host/session/progress.hpp"

#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

using namespace std::chrono_literals;

constexpr base::Duration on_a_terminal = 100ms;
/// A job that takes less says nothing in a log.
constexpr base::Duration in_a_log = 2s;

}  // namespace

Progress::Progress(std::string who, std::string what)
    : who_(std::move(who)), what_(std::move(what)), is_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (has_line_) fmt::print(stderr, "\r\033[K");
}

void Progress::show(std::size_t done, std::size_t total, base::TimePoint now) {
  auto const period = is_terminal_ ? on_a_terminal : in_a_log;
  if (!std::exchange(has_begun_, true)) next_ = now + period;
  if (now < next_) return;
  next_ = now + period;
  has_line_ = is_terminal_;
  fmt::print(stderr, "{}{}: {} of {} {}{}", is_terminal_ ? "\r\033[K" : "", who_, done, total, what_,
             is_terminal_ ? "" : "\n");
}

}  // namespace lapwing::host
