#include "base/clock_offset.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::base {

using namespace std::chrono_literals;

namespace {

/// Crystals go apart by a millisecond in so long at most.
constexpr Duration window = 10s;
/// Nothing is held up for so long: their clock was set, or began anew.
constexpr Duration another_clock = 1s;

}  // namespace

TimePoint ClockOffset::here(std::chrono::nanoseconds theirs, TimePoint arrived) {
  Duration const offset = std::chrono::duration_cast<Duration>(arrived.time_since_epoch() - theirs);
  if (least_ && offset - *least_ > another_clock) least_ = least_now_ = std::nullopt;
  if (least_now_ && arrived - window_began_ > window) {
    least_ = std::exchange(least_now_, std::nullopt);
  }
  if (!least_now_) window_began_ = arrived;
  least_now_ = std::min(least_now_.value_or(offset), offset);
  least_ = std::min(least_.value_or(offset), offset);
  return TimePoint(std::chrono::duration_cast<Duration>(theirs) + *least_);
}

}  // namespace lapwing::base
