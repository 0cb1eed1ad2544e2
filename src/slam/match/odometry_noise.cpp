#include "slam/match/odometry_noise.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::slam {
namespace {

constexpr std::size_t most_remembered = 200;  // key frames; some minutes
constexpr std::size_t enough = 20;            // before that the nominal spread stands
constexpr double least_scale = 1.0;           // a robot that has driven well may still slip
constexpr double most_scale = 3.0;
constexpr double gaussian_p90 = 1.645;  // of |error| / sigma

}  // namespace

OdometryNoise::Spread OdometryNoise::nominal(Pose2 const& step) {
  auto const length = std::hypot(step.x, step.y);
  return {.shift_m = 0.03 + 0.1 * length, .turn_rad = 0.02 + 0.15 * std::abs(step.yaw) + 0.02 * length};
}

OdometryNoise::Spread OdometryNoise::of(Pose2 const& step) const {
  auto const spread = nominal(step);
  return {.shift_m = spread.shift_m * shift_.scale, .turn_rad = spread.turn_rad * turn_.scale};
}

void OdometryNoise::Ratios::add(double ratio) {
  last.push_back(ratio);
  if (last.size() > most_remembered) last.pop_front();
  if (last.size() < enough) return;
  std::vector<double> sorted(last.begin(), last.end());
  auto const p90 = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() * 9 / 10);
  std::ranges::nth_element(sorted, p90);
  scale = std::clamp(*p90 / gaussian_p90, least_scale, most_scale);
}

void OdometryNoise::learn(Pose2 const& step, Pose2 const& predicted, Pose2 const& matched, bool is_pinned) {
  auto const spread = nominal(step);
  auto const error = between(predicted, matched);
  turn_.add(std::abs(error.yaw) / spread.turn_rad);
  if (is_pinned) shift_.add(std::hypot(error.x, error.y) / std::sqrt(2.0) / spread.shift_m);
}

OdometryNoise::Memory OdometryNoise::memory() const {
  return {.shift = {shift_.last.begin(), shift_.last.end()}, .turn = {turn_.last.begin(), turn_.last.end()}};
}

void OdometryNoise::remember(Memory const& memory) {
  for (auto const ratio : memory.shift) shift_.add(ratio);
  for (auto const ratio : memory.turn) turn_.add(ratio);
}

}  // namespace lapwing::slam
