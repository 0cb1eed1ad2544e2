#pragma once

#include <chrono>
#include <optional>

#include "base/time.hpp"

namespace lapwing::robot::rover {

/// Moments of another clock on ours. What comes over a link comes late now and then, and never early: so the clocks lie
/// apart by the least that was seen lately, and what came later than that was held up on its way.
class ClockOffset {
 public:
  /// `theirs`: of their clock, whatever it counts from, in what has just come.
  [[nodiscard]] base::TimePoint here(std::chrono::nanoseconds theirs, base::TimePoint arrived);

 private:
  std::optional<base::Duration> least_;  ///< of the window before this one, and of this one
  std::optional<base::Duration> least_now_;
  base::TimePoint window_began_{};
};

}  // namespace lapwing::robot::rover
