#include "fleet/battery_time.hpp"

#include <algorithm>

namespace lapwing::fleet {

namespace {

constexpr double step = 0.01;  // vehicles report whole percents
constexpr double least_fall = 0.03;
constexpr std::size_t levels_kept = 6;
constexpr double swapped = 0.02;
constexpr base::Duration longest = std::chrono::hours(48);  // beyond it nothing is drawn that matters

}  // namespace

std::optional<base::Duration> BatteryTime::add(double remaining, base::TimePoint now) {
  if (!levels_.empty() && remaining > levels_.back().remaining + swapped) levels_.clear();
  if (levels_.empty() || remaining <= levels_.back().remaining - step / 2.0) levels_.push_back({remaining, now});
  if (levels_.size() > levels_kept) levels_.pop_front();

  auto const& first = levels_.front();
  auto const& last = levels_.back();
  double const fallen = first.remaining - last.remaining;
  double const fall_s = base::to_seconds(last.reached - first.reached);
  if (fallen < least_fall - 1e-9 || fall_s <= 0.0) return std::nullopt;
  double const since_first_s = base::to_seconds(now - first.reached);
  double const per_second = std::min(fallen / fall_s, (fallen + step) / since_first_s);
  double const left_s = std::clamp(remaining, 0.0, 1.0) / per_second;
  if (!(left_s < base::to_seconds(longest))) return std::nullopt;
  return base::from_seconds(left_s);
}

}  // namespace lapwing::fleet
