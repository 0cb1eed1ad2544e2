#pragma once

#include "base/time.hpp"

namespace lapwing::base {

/// What the clock on the wall shows, at whatever pace the loop's time runs: what log lines are stamped with, and
/// everything that people compare with them.
[[nodiscard]] inline UtcTime wall_now() {
  return std::chrono::system_clock::now();
}

}  // namespace lapwing::base
