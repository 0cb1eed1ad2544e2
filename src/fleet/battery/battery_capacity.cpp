#include "fleet/battery/battery_capacity.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::fleet {

void BatteryCapacity::add(double remaining, double drawn_ah, bool counts_from_full) {
  constexpr int swapped_percent = 2;
  constexpr double swapped_ah = 0.05;
  int const percent = static_cast<int>(std::lround(remaining * 100.0));
  bool const is_another =
      lowest_percent_ && (percent > *lowest_percent_ + swapped_percent || drawn_ah < drawn_ah_ - swapped_ah);
  if (is_another) forget();
  if (lowest_percent_ && percent < *lowest_percent_) {
    Step const step{percent, drawn_ah_, drawn_ah};
    (first_ ? latest_ : first_) = step;
  }
  lowest_percent_ = std::min(percent, lowest_percent_.value_or(percent));
  drawn_ah_ = drawn_ah;
  if (!counts_from_full) return;
  // Rounded, the share that was drawn is up to half a percent more than reported; cut off, up to one percent less.
  double const most = 1.005 - remaining;
  double const least = 0.99 - remaining;
  from_full_.low = std::max(from_full_.low, drawn_ah / most);
  if (least > 0.001) from_full_.high = std::min(from_full_.high, drawn_ah / least);
}

BatteryCapacity::Bounds BatteryCapacity::by_steps() const {
  if (!first_ || !latest_) return {};
  double const share = (first_->percent - latest_->percent) / 100.0;
  return {std::max(0.0, (latest_->drawn_before_ah - first_->drawn_after_ah) / share),
          (latest_->drawn_after_ah - first_->drawn_before_ah) / share};
}

std::optional<BatteryCapacity::Value> BatteryCapacity::value() const {
  constexpr double worst_error = 1.0 / 3.0;
  auto const steps = by_steps();
  Bounds both{std::max(steps.low, from_full_.low), std::min(steps.high, from_full_.high)};
  if (both.low > both.high) both = steps;  // it was not full when it began to count
  if (!std::isfinite(both.high)) return std::nullopt;
  double const ah = (both.low + both.high) / 2.0;
  double const error = (both.high - both.low) / 2.0 / ah;
  if (!(ah > 0.0) || error > worst_error) return std::nullopt;
  return Value{ah, error};
}

}  // namespace lapwing::fleet
