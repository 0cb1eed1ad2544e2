#include "vehicle/energy/drain_meter.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::vehicle {

using namespace std::chrono_literals;

namespace {

constexpr double percent = 0.01;
constexpr auto window = 3min;
/// Between steps: fewer say nothing of how much they differ.
constexpr std::size_t least_parts = 3;
/// More than that at once was another battery, or a reading that was none.
constexpr double swapped = 0.02;
/// That the way home draws otherwise than the way before it.
constexpr double way_home_error = 0.05;
constexpr double last_time_error = 0.25;

}  // namespace

std::optional<Drain> DrainMeter::add(std::optional<double> charge, bool is_under_way, base::TimePoint now) {
  if (!charge) return drain_;
  bool const begins = is_under_way && (!was_under_way_ || std::abs(*charge - lowest_) > swapped);
  was_under_way_ = is_under_way;
  if (begins) set_out(*charge);
  if (is_under_way) take(*charge, now);
  return drain_;
}

void DrainMeter::set_out(double charge) {
  lowest_ = charge;
  steps_.clear();
  if (drain_) drain_->error = std::max(drain_->error, last_time_error);
}

/// The charge at which it sets out has been falling for some time: the first that counts is the one after.
void DrainMeter::take(double charge, base::TimePoint now) {
  if (charge <= lowest_ - 0.5 * percent) {
    lowest_ = charge;
    steps_.push_back({charge, now});
    while (now - steps_.front().reached > window && steps_.size() > least_parts + 1) steps_.pop_front();
  }
  if (steps_.size() > least_parts) learn(now);
}

void DrainMeter::learn(base::TimePoint now) {
  auto const& first = steps_.front();
  double const fallen = first.charge - lowest_;
  double const fall_s = base::to_seconds(steps_.back().reached - first.reached);
  if (fall_s <= 0.0) return;
  double const mean = fallen / fall_s;
  double squares = 0.0;
  for (std::size_t i = 1; i < steps_.size(); ++i) {
    double const part_s = base::to_seconds(steps_[i].reached - steps_[i - 1].reached);
    if (part_s <= 0.0) return;
    double const off = (steps_[i - 1].charge - steps_[i].charge) / part_s - mean;
    squares += part_s / fall_s * off * off;
  }
  auto const parts = static_cast<double>(steps_.size() - 1);
  double const spread = std::sqrt(squares / parts) / mean;
  // When nothing has fallen for longer than one more step should have taken, it falls that much slower.
  double const since_first_s = base::to_seconds(now - first.reached);
  double const per_s = std::min(mean, (fallen + percent) / since_first_s);
  drain_ = Drain{.per_s = per_s, .error = std::min(1.0, spread + way_home_error)};
}

}  // namespace lapwing::vehicle
