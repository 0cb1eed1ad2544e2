#include "explore/simulated/carrier.hpp"

#include <algorithm>
#include <cmath>

#include "geo/position.hpp"

namespace lapwing::explore {

Carrier::State Carrier::after(State const& state, Motion wanted, double seconds) const {
  double const most_faster = limits_.acceleration_m_s2 * seconds;
  double const most_turn = limits_.turn_acceleration_rad_s2 * seconds;
  double const speed = std::clamp(wanted.speed_m_s, 0.0, limits_.speed_m_s);
  double const turn = std::clamp(wanted.turn_rad_s, -limits_.turn_rad_s, limits_.turn_rad_s);
  State next = state;
  next.motion.speed_m_s += std::clamp(speed - state.motion.speed_m_s, -most_faster, most_faster);
  next.motion.turn_rad_s += std::clamp(turn - state.motion.turn_rad_s, -most_turn, most_turn);
  double const way_m = next.motion.speed_m_s * seconds;
  double const turned = next.motion.turn_rad_s * seconds;
  // The chord of the arc lies in its middle direction.
  double const half = turned / 2.0;
  double const chord_m = std::abs(half) < 1e-9 ? way_m : way_m * std::sin(half) / half;
  double const yaw = state.pose.yaw_rad + half;
  next.pose.position = state.pose.position + chord_m * Shift(std::cos(yaw), std::sin(yaw));
  next.pose.yaw_rad = geo::wrap_pi(state.pose.yaw_rad + turned);
  return next;
}

std::vector<Place> Carrier::braking_places(double seconds) const {
  std::vector<Place> places;
  for (State state{pose_, motion_}; state.motion.speed_m_s > 0.0;) {
    state = after(state, {}, seconds);
    places.push_back(state.pose.position);
  }
  return places;
}

void Carrier::drive(Motion wanted, double seconds, std::function<bool(Place const&)> const& is_safe) {
  State const now{pose_, motion_};
  auto const is_all_safe = [&](State state) {
    while (true) {
      if (!is_safe(state.pose.position)) return false;
      if (state.motion.speed_m_s <= 0.0) return true;
      state = after(state, {}, seconds);
    }
  };
  auto next = after(now, wanted, seconds);
  // Whoever stands may turn: a disc does not change by it.
  if (next.motion.speed_m_s > 0.0 && !is_all_safe(next)) next = after(now, {}, seconds);
  if (next.motion.speed_m_s <= 0.0 && now.motion.speed_m_s <= 0.0) next = after(now, {0.0, wanted.turn_rad_s}, seconds);
  driven_m_ += distance_m(next.pose.position, pose_.position);
  pose_ = next.pose;
  motion_ = next.motion;
}

}  // namespace lapwing::explore
