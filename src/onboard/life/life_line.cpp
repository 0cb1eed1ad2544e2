#include "onboard/life/life_line.hpp"

#include <fcntl.h>
#include <sys/socket.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace lapwing::onboard {

std::optional<base::Descriptor> LifeLine::from_environment() {
  auto const* const text = std::getenv(life_variable);
  if (text == nullptr) return std::nullopt;
  std::string_view const digits = text;
  int number = -1;
  auto const [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  bool const is_number = error == std::errc() && end == digits.data() + digits.size();
  ::unsetenv(life_variable);  // what this process starts has no part in it
  if (!is_number || ::fcntl(number, F_SETFD, FD_CLOEXEC) != 0) return std::nullopt;
  return base::Descriptor(number);
}

LifeLine::LifeLine(base::Loop& loop, base::Descriptor end, std::function<void()> orphaned)
    : loop_(loop), end_(std::move(end)), orphaned_(std::move(orphaned)), scope_(loop) {
  scope_.spawn(live());
}

base::Task<> LifeLine::live() {
  for (;;) {
    auto const sent = ::send(end_.get(), ".", 1, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) break;
    co_await loop_.sleep(life_period);
  }
  orphaned_();
}

}  // namespace lapwing::onboard
