#include "plan/paper_motion.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::plan {

double leg_time_s(double length_m, double entry_m_s, double exit_m_s, Performance const& performance) {
  double const v = performance.cruise_m_s;
  double const a = performance.accel_m_s2;
  double const b = performance.brake_m_s2;
  if (a <= 0.0 || b <= 0.0) return length_m / v;
  double const entry = std::min(entry_m_s, v);
  double const exit = std::min(exit_m_s, v);
  double const ramp_up_m = (v * v - entry * entry) / (2.0 * a);
  double const ramp_down_m = (v * v - exit * exit) / (2.0 * b);
  double const even_m = length_m - ramp_up_m - ramp_down_m;
  if (even_m >= 0.0) return (v - entry) / a + (v - exit) / b + even_m / v;
  // Too short for the cruise speed: up to a peak and down again.
  double const square =
      (length_m + entry * entry / (2.0 * a) + exit * exit / (2.0 * b)) / (1.0 / (2.0 * a) + 1.0 / (2.0 * b));
  double const peak = std::max(std::sqrt(std::max(square, 0.0)), 0.1);
  return std::max(0.0, peak - entry) / a + std::max(0.0, peak - exit) / b;
}

double vertical_time_s(double up_m, Performance const& performance) {
  double const speed = up_m > 0.0 ? performance.climb_m_s : performance.descent_m_s;
  double const size_m = std::abs(up_m);
  double const a = performance.vertical_accel_m_s2;
  if (a <= 0.0 || size_m == 0.0) return size_m / speed;
  double const ramps_m = speed * speed / a;
  return size_m >= ramps_m ? size_m / speed + speed / a : 2.0 * std::sqrt(size_m / a);
}

void Curves::step(double turn_rate_rad_s, double dt_s) {
  course_rad_ = geo::wrap_pi(course_rad_ + turn_rate_rad_s * dt_s);
  at_.north += speed_m_s_ * std::cos(course_rad_) * dt_s;
  at_.east += speed_m_s_ * std::sin(course_rad_) * dt_s;
}

LegFlown Curves::straight(double time_s) {
  step(0.0, time_s);
  return {time_s, speed_m_s_ * time_s};
}

LegFlown Curves::go_to(geo::Ned goal, double radius_m) {
  constexpr double dt_s = 0.1;
  constexpr double look_ahead_s = 4.0;  // aims at the point of the line that it reaches then (Park, Deyst, How 2004)
  constexpr double gain_per_s = 0.8;
  auto const from = at_;
  double const leg_n = goal.north - from.north;
  double const leg_e = goal.east - from.east;
  double const length_m = std::hypot(leg_n, leg_e);
  // Nobody needs longer than the way there and some circles; what circles for ever has to end as well.
  double const longest_s = 4.0 * length_m / speed_m_s_ + 60.0;
  LegFlown flown;
  for (; flown.time_s < longest_s; flown.time_s += dt_s, flown.path_m += speed_m_s_ * dt_s) {
    double const gap_n = goal.north - at_.north;
    double const gap_e = goal.east - at_.east;
    bool const is_past = length_m > radius_m && gap_n * leg_n + gap_e * leg_e <= 0.0;
    if (is_past || std::hypot(gap_n, gap_e) <= radius_m) break;
    double aim_n = gap_n;
    double aim_e = gap_e;
    if (length_m > 1.0) {
      double const ahead_m = look_ahead_s * speed_m_s_;
      double const done_m = ((at_.north - from.north) * leg_n + (at_.east - from.east) * leg_e) / length_m;
      double const along_m = std::max(done_m, -ahead_m) + ahead_m;
      aim_n = from.north + leg_n * along_m / length_m - at_.north;
      aim_e = from.east + leg_e * along_m / length_m - at_.east;
    }
    double const error = geo::wrap_pi(std::atan2(aim_e, aim_n) - course_rad_);
    double const limit = turn_rate_rad_s_;
    step(std::clamp(gain_per_s * error, -limit, limit), dt_s);
  }
  return flown;
}

}  // namespace lapwing::plan
