#include "robot/planner/held_up/recovery.hpp"

#include <cmath>
#include <numbers>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr double slow_m_s = 0.1;
constexpr double back_m = 0.15;
constexpr double open_m = 0.4;
constexpr double track_m = 0.8;
constexpr double keep_m = 0.045;  ///< off what its laser sees
constexpr double longest_s = 8.0;
constexpr int directions = 32;

}  // namespace

void Recovery::begin(Now const& now) {
  int const step = tried_ % 3;
  int const rounds = tried_ / 3;
  double const farther = 1.0 + rounds;
  ++tried_;
  from_ = {now.pose.x, now.pose.y};
  bool const can_back = now.room.towards(std::numbers::pi, now.radius_m + keep_m) > back_m;
  if (step == 0 && can_back) {
    far_m_ = back_m;
    way_ = Way{.yaw_rad = now.pose.yaw, .speed_m_s = -slow_m_s};
  } else if (step == 1 && now.driven.size() > 1) {
    far_m_ = track_m * farther;
    way_ = along_track(now);
  } else {
    far_m_ = open_m * farther;
    way_ = into_the_open(now);
  }
  until_s_ = now.time_s + longest_s * farther;
}

Way Recovery::along_track(Now const& now) const {
  Way way{.points = {from_}, .clear_to = 0, .speed_m_s = slow_m_s};
  double length_m = 0.0;
  for (auto at = now.driven.rbegin(); at != now.driven.rend() && length_m < far_m_; ++at) {
    Place const next(at->x, at->y);
    length_m += geo::distance_m(way.points.back(), next);
    way.points.push_back(next);
  }
  return way;
}

Way Recovery::into_the_open(Now const& now) const {
  double best = 0.0;
  double most_m = -1.0;
  for (int i = 0; i < directions; ++i) {
    double const bearing = geo::wrap_pi(2.0 * std::numbers::pi * i / directions);
    double const room_m = now.room.towards(bearing, now.radius_m + keep_m);
    if (room_m <= most_m) continue;
    best = bearing;
    most_m = room_m;
  }
  return {.yaw_rad = geo::wrap_pi(now.pose.yaw + best), .speed_m_s = slow_m_s};
}

std::optional<Way> Recovery::way(Now const& now) {
  bool const is_over = now.time_s >= until_s_ || geo::distance_m(Place(now.pose.x, now.pose.y), from_) >= far_m_;
  if (is_over) way_.reset();
  return way_;
}

}  // namespace lapwing::robot
