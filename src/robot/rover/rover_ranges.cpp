#include "robot/rover/rover_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geo/position.hpp"

namespace lapwing::robot::rover {

using namespace std::chrono_literals;

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr std::size_t sectors = 72;  ///< that an OBSTACLE_DISTANCE has
constexpr double least_step_rad = full_turn / 1000.0;
/// So long it takes until every sensor has spoken once.
constexpr base::Duration all_have_spoken = 1s;
/// Sensors that speak one after the other make a scan so often.
constexpr base::Duration scan_period = 95ms;
/// What a sensor said before that says nothing of now.
constexpr base::Duration beam_is_old = 300ms;

/// As scans have it: 0 where nothing was measured, `no_return_m` where nothing is.
float range_of(double distance_m, double least_m, double no_return_m) {
  if (!std::isfinite(distance_m) || distance_m <= 0.0 || distance_m < least_m) return 0.0F;
  return static_cast<float>(std::min(distance_m, no_return_m));
}

}  // namespace

void RoverRanges::describe(std::vector<double> const& bearings_rad, double most_m) {
  std::ranges::sort(order_, {}, [&](std::size_t i) { return bearings_rad[i]; });
  sensor_.emplace();
  sensor_->no_return_m = static_cast<float>(most_m);
  for (auto const i : order_) sensor_->bearings_rad.push_back(static_cast<float>(bearings_rad[i]));
}

std::optional<std::vector<float>> RoverRanges::take(mavlink::ObstacleDistance const& seen) {
  bool const is_from_ahead = seen.frame == mavlink::MavFrame::body_frd || seen.frame == mavlink::MavFrame::body_ned;
  auto const exact = seen.exact_step_rad.value_or(0.0);
  auto const step = exact != 0.0 ? exact : seen.step_rad.value_or(0.0);
  if (!is_from_ahead || std::abs(step) < least_step_rad || !seen.most_m || *seen.most_m <= 0.0) return std::nullopt;
  if (sensor_ && !is_of_sectors_) return std::nullopt;
  if (!sensor_) {
    // Those beyond a full turn would be the first ones again.
    auto const count =
        std::min<std::size_t>(sectors, static_cast<std::size_t>(std::lround(full_turn / std::abs(step))));
    std::vector<double> bearings;
    for (std::size_t i = 0; i < count; ++i)
      bearings.push_back(geo::wrap_pi(-(seen.first_bearing_rad.value_or(0.0) + static_cast<double>(i) * step)));
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    describe(bearings, *seen.most_m);
    is_of_sectors_ = true;
  }
  auto const& distances = seen.distances_m;
  std::vector<float> ranges;
  for (auto const i : order_)
    ranges.push_back(i < distances.size() ? range_of(distances[i], seen.least_m.value_or(0.0), sensor_->no_return_m)
                                          : 0.0F);
  return ranges;
}

std::optional<std::vector<float>> RoverRanges::take(mavlink::DistanceSensor const& seen, base::TimePoint now) {
  if (is_of_sectors_ || seen.orientation >= directions || !seen.distance_m || !seen.most_m || *seen.most_m <= 0.0)
    return std::nullopt;
  if (!beams_since_) beams_since_ = now;
  // Of several that look the same way the nearest counts.
  auto& beam = beams_.at(seen.orientation);
  bool const is_behind = beam && now - beam->heard < scan_period / 2 && *seen.distance_m > beam->distance_m;
  if (!is_behind) beam = Beam{*seen.distance_m, seen.least_m.value_or(0.0), *seen.most_m, now};
  return beams_as_scan(now);
}

std::optional<std::vector<float>> RoverRanges::beams_as_scan(base::TimePoint now) {
  if (!sensor_) {
    if (now - *beams_since_ < all_have_spoken) return std::nullopt;
    std::vector<double> bearings(directions);
    double most_m = 0.0;
    for (std::size_t i = 0; i < directions; ++i) {
      bearings[i] = geo::wrap_pi(-static_cast<double>(i) * full_turn / directions);
      if (!beams_[i]) continue;
      order_.push_back(i);
      most_m = std::max(most_m, beams_[i]->most_m);
    }
    describe(bearings, most_m);
  }
  if (told_ && now - *told_ < scan_period) return std::nullopt;
  told_ = now;
  std::vector<float> ranges;
  for (auto const i : order_) {
    auto const& beam = *beams_[i];
    bool const is_new = now - beam.heard <= beam_is_old;
    // This message has no word for "nothing there": who sees nothing says the most that it can measure, and so does
    // who is blind.
    bool const has_hit = is_new && beam.distance_m < beam.most_m;
    ranges.push_back(has_hit ? range_of(beam.distance_m, beam.least_m, sensor_->no_return_m) : 0.0F);
  }
  return ranges;
}

}  // namespace lapwing::robot::rover
