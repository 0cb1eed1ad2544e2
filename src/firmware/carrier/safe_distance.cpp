#include "firmware/carrier/safe_distance.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::firmware {

namespace {

/// Where the rule leaves no more than this the body stands: wheels do not creep, they stick and jerk.
float constexpr creeping_m_s = 0.01F;
/// And goes on where it leaves this, so that an echo's trembling does not start it again and again.
float constexpr going_on_m_s = 0.03F;

}  // namespace

float SafeDistance::allowed(float clearance_m) const {
  float const free_m = clearance_m - tuning_.safe_distance_m - tuning_.far_enough_m;
  if (free_m <= 0) return 0;
  float const t = tuning_.reaction_s;
  return braking_m_s2_ * (std::sqrt(t * t + 2 * free_m / braking_m_s2_) - t);
}

bool SafeDistance::is_believed(Time now, bool is_near) {
  if (!is_near) {
    is_near_ = false;
    return false;
  }
  if (!is_near_) near_since_ = now;
  is_near_ = true;
  return now - near_since_ >= tuning_.believe_after;
}

SafeDistance::Answer SafeDistance::limit(Time now, float wanted_m_s, Clearance const& clearance, float way_m) {
  if (away_ != Away::none) {
    float const behind_m = away_ == Away::back ? clearance.ahead_m : clearance.back_m;
    if (behind_m <= tuning_.safe_distance_m + tuning_.far_enough_m) return go_away(clearance, way_m);
    rest();
  }
  bool const is_ahead = wanted_m_s > 0;
  float const towards_m = is_ahead ? clearance.ahead_m : clearance.back_m;
  bool const is_near = wanted_m_s != 0 && towards_m < tuning_.safe_distance_m;
  if (is_believed(now, is_near)) {
    away_ = is_ahead ? Away::back : Away::ahead;
    began_at_m_ = way_m;
    return go_away(clearance, way_m);
  }
  float const most = allowed(towards_m);
  is_held_ = std::abs(wanted_m_s) > most && most < (is_held_ ? going_on_m_s : creeping_m_s);
  if (is_held_) return {.speed_m_s = 0, .rules = true};
  return {.speed_m_s = std::clamp(wanted_m_s, -most, most)};
}

SafeDistance::Answer SafeDistance::go_away(Clearance const& clearance, float way_m) {
  bool const is_back = away_ == Away::back;
  bool const is_enough = std::abs(way_m - began_at_m_) >= tuning_.longest_retreat_m;
  float const free_m_s = allowed(is_back ? clearance.back_m : clearance.ahead_m);
  float const speed = is_enough ? 0.0F : std::min(tuning_.retreat_speed_m_s, free_m_s);
  return {.speed_m_s = is_back ? -speed : speed, .rules = true, .has_gone_back_too_far = is_enough};
}

void SafeDistance::rest() {
  away_ = Away::none;
  is_near_ = false;
  is_held_ = false;
}

}  // namespace lapwing::firmware
