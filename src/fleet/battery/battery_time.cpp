#include "fleet/battery/battery_time.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::fleet {

using vehicle::Drain;

namespace {

constexpr double step = 0.01;  // vehicles report whole percents
constexpr double least_fall = 0.02;
constexpr std::size_t levels_kept = 6;
constexpr double swapped = 0.02;
constexpr double memory_s = 20.0;      // of the current: it follows a change of pace in that time
constexpr double climb_counts = 0.1;   // for a second of level flight
constexpr double climb_error = 0.4;    // what a climb draws more or a descent less than level flight
constexpr double last_flight_s = 5.0;  // of level flight is what the flight before is worth
constexpr double longest_gap_s = 5.0;  // one report stands for no longer time
constexpr double no_current_a = 0.05;  // less is a sensor that is not there

}  // namespace

BatteryEstimate BatteryTime::add(BatteryReport const& report, base::TimePoint now) {
  double const past_s = last_ ? std::min(base::to_seconds(now - *last_), longest_gap_s) : 0.0;
  last_ = now;
  if (report.remaining > remaining_ + swapped) begin_battery();
  remaining_ = report.remaining;
  count_drawn(report, past_s);
  if (report.is_working && !was_working_) begin_flight();
  was_working_ = report.is_working;
  if (report.is_working) {
    if (report.current_a) take_current(*report.current_a, past_s, report.is_level);
    take_level(report.remaining, now);
  }
  auto const drain = by_current().or_else([this] { return by_levels_; });
  if (!drain) return {};
  auto const lasts = vehicle::endurance(report.remaining, *drain);
  return {.now = report.is_working ? lasts : std::nullopt, .in_flight = lasts};
}

/// The vehicle draws what it drew; how long that lasts is to be seen.
void BatteryTime::begin_battery() {
  capacity_.forget();
  by_levels_.reset();
  levels_.clear();
  lowest_.reset();
}

void BatteryTime::begin_flight() {
  constexpr double last_flight_error = 0.25;
  if (current_.weight_s > last_flight_s) {
    double const share = last_flight_s / current_.weight_s;
    current_.squares *= share;
    current_.level_s *= share;
    current_.weight_s = last_flight_s;
  }
  lowest_.reset();
  levels_.clear();
  if (by_levels_) by_levels_->error = std::max(by_levels_->error, last_flight_error);
}

void BatteryTime::count_drawn(BatteryReport const& report, double past_s) {
  constexpr double s_per_h = 3600.0;
  if (report.drawn_ah.has_value() != tells_drawn_) capacity_.forget();
  tells_drawn_ = report.drawn_ah.has_value();
  drawn_ah_ += report.current_a.value_or(0.0) * past_s / s_per_h;
  if (!tells_drawn_ && !report.current_a) return;
  // What was drawn before it was first heard of is the vehicle's secret unless it tells.
  bool const counts_from_full = report.counts_from_full && tells_drawn_;
  capacity_.add(report.remaining, report.drawn_ah.value_or(drawn_ah_), counts_from_full);
}

void BatteryTime::take_current(double current_a, double past_s, bool is_level) {
  double const keep = std::exp(-past_s / memory_s);
  double const weight_s = past_s * (is_level ? 1.0 : climb_counts);
  current_.weight_s = current_.weight_s * keep + weight_s;
  current_.level_s = current_.level_s * keep + (is_level ? weight_s : 0.0);
  current_.squares *= keep;
  if (current_.weight_s <= 0.0) return;
  double const before_a = current_.mean_a;
  current_.mean_a += weight_s / current_.weight_s * (current_a - before_a);
  current_.squares += weight_s * (current_a - before_a) * (current_a - current_.mean_a);
}

/// The level at which a flight begins has been falling for some time: the first that counts is the one after.
void BatteryTime::take_level(double remaining, base::TimePoint now) {
  if (!lowest_) lowest_ = remaining;
  if (remaining <= *lowest_ - step / 2.0) {
    lowest_ = remaining;
    levels_.push_back({remaining, now});
  }
  if (levels_.size() > levels_kept) levels_.pop_front();
  if (levels_.empty()) return;
  auto const& first = levels_.front();
  double const fallen = first.remaining - *lowest_;
  double const fall_s = base::to_seconds(levels_.back().reached - first.reached);
  if (fallen < least_fall - 1e-9 || fall_s <= 0.0) return;
  // When nothing has fallen for longer than one more step should have taken, it falls that much slower.
  double const since_first_s = base::to_seconds(now - first.reached);
  double const per_s = std::min(fallen / fall_s, (fallen + step) / since_first_s);
  by_levels_ = Drain{.per_s = per_s, .error = step / 2.0 / fallen + 0.05};
}

std::optional<Drain> BatteryTime::by_current() const {
  constexpr double s_per_h = 3600.0;
  auto const capacity = capacity_.value();
  if (!capacity || current_.weight_s <= 0.0 || current_.mean_a < no_current_a) return std::nullopt;
  double const spread = std::sqrt(std::max(0.0, current_.squares / current_.weight_s)) / current_.mean_a;
  double const unsure = 0.5 / (1.0 + current_.weight_s);
  double const climbs = climb_error * (1.0 - current_.level_s / current_.weight_s);
  // What the climb drew is in the spread already; the others have nothing to do with each other.
  double const error = capacity->error + std::hypot(std::max(spread, climbs), unsure);
  return Drain{.per_s = current_.mean_a / s_per_h / capacity->ah, .error = error};
}

}  // namespace lapwing::fleet
