#pragma once

#include <chrono>
#include <optional>

#include "base/time.hpp"

namespace lapwing::base {

/// Moments of another clock on ours. What comes over a link comes late now and then, and never early: so the clocks lie
/// apart by the least that was seen lately, and what came later than that was held up on its way.
class ClockOffset {
 public:
  /// `theirs`: of their clock, whatever it counts from, in what has just come.
  [[nodiscard]] TimePoint here(std::chrono::nanoseconds theirs, TimePoint arrived);

 private:
  std::optional<Duration> least_;  ///< of the window before this one, and of this one
  std::optional<Duration> least_now_;
  TimePoint window_began_{};
};

}  // namespace lapwing::base
