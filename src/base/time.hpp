#pragma once

#include <chrono>
#include <cmath>

namespace lapwing::base {

using Duration = std::chrono::nanoseconds;

/// The time line of one `Loop`: starts at zero when the loop is made, never goes back, may run faster than the wall.
/// There is no global `now()`: ask the loop, so that tests and the simulator decide what time it is.
struct LoopClock {
  using duration = Duration;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<LoopClock>;
  static constexpr bool is_steady = true;
};

using TimePoint = LoopClock::time_point;
using UtcTime = std::chrono::system_clock::time_point;

/// Seconds as a real number, for arithmetic with physical quantities.
[[nodiscard]] inline double to_seconds(Duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// The nearest representable duration. Precondition: finite, within +-290 years.
[[nodiscard]] inline Duration from_seconds(double seconds) {
  return Duration(static_cast<Duration::rep>(std::llround(seconds * 1e9)));
}

}  // namespace lapwing::base
