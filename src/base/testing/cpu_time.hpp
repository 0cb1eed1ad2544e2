#pragma once

#include <chrono>
#include <ctime>

namespace lapwing::base {

/// What this thread has computed so far. Tests that something is soon done measure it by this: by the clock on the wall
/// a busy machine takes as long as it likes.
[[nodiscard]] inline std::chrono::nanoseconds cpu_time() {
  std::timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
}

}  // namespace lapwing::base
