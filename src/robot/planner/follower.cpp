#include "robot/planner/follower.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr double look_ahead_m = 0.4;
constexpr double arrived_m = 0.12;
constexpr double turn_first_rad = 0.6;  ///< farther to the side than this, the robot turns where it stands
constexpr double turn_gain = 2.0;
/// The board's own rule looks two centimetres beside the hull. Ways keep farther off, so that the noise of a range does
/// not hold the robot up where they just fit.
constexpr double touches_m = 0.02;
/// What it goes by at: more than that, so that it is past before the board stops it.
constexpr double goes_by_m = 0.045;
constexpr double sees_ahead_m = 0.4;
constexpr double bearing_step = 0.09;
constexpr int most_bearing_steps = 12;  ///< to each side
constexpr int steps_to_change_sides = 3;

double distance_m(slam::Pose2 const& pose, Place const& place) {
  return std::hypot(place.x() - pose.x, place.y() - pose.y);
}

}  // namespace

void Follower::take(Way way) {
  way_ = std::move(way);
  at_ = 0;
  has_arrived_ = false;
}

Motion Follower::steer(slam::Pose2 const& pose, Room const& room) {
  bool const goes_back = way_.speed_m_s < 0.0;
  double const brakes_m = std::max(0.0, room.towards(goes_back ? std::numbers::pi : 0.0, limits_.radius_m + touches_m));
  double const stops_m_s = std::sqrt(2.0 * limits_.acceleration_m_s2 * brakes_m);
  double const most_m_s = goes_back ? std::max(way_.speed_m_s, -stops_m_s) : std::min(way_.speed_m_s, stops_m_s);
  Motion wanted;
  if (way_.yaw_rad) {
    double const off = geo::wrap_pi(*way_.yaw_rad - pose.yaw);
    wanted = {std::abs(off) > turn_first_rad ? 0.0 : most_m_s, turn_gain * off};
  } else if (!way_.points.empty() && !has_arrived_) {
    wanted = along(pose, room, most_m_s);
  }
  double const most_rad_s = std::min(limits_.turn_rad_s, way_.turn_rad_s);
  wanted.turn_rad_s = std::clamp(wanted.turn_rad_s, -most_rad_s, most_rad_s);
  return wanted;
}

/// The direction nearest to the wanted one in which there is room for so far, or the wanted one where there is none.
double Follower::free_bearing(double wanted, double far_m, Room const& room) {
  double const needed_m = std::min(far_m, sees_ahead_m);
  for (double const off_m : {goes_by_m, touches_m}) {
    auto const is_free = [&](double bearing) {
      return room.towards(bearing, limits_.radius_m + off_m, sees_ahead_m) >= needed_m;
    };
    if (is_free(wanted)) return wanted;
    for (int step = 1; step <= most_bearing_steps + steps_to_change_sides; ++step) {
      double const same = wanted + shuns_to_ * step * bearing_step;
      if (step <= most_bearing_steps && is_free(same)) return same;
      int const other_step = step - steps_to_change_sides;
      double const other = wanted - shuns_to_ * other_step * bearing_step;
      if (other_step < 1 || !is_free(other)) continue;
      shuns_to_ = -shuns_to_;
      return other;
    }
  }
  return wanted;
}

Motion Follower::along(slam::Pose2 const& pose, Room const& room, double most_m_s) {
  auto const& points = way_.points;
  // A way may come by the same place twice, so that only a little is looked ahead for where the robot is.
  double looked_m = 0.0;
  for (std::size_t i = at_ + 1; i < points.size() && looked_m < 1.0; ++i) {
    looked_m += geo::distance_m(points[i - 1], points[i]);
    if (distance_m(pose, points[i]) <= distance_m(pose, points[at_])) at_ = i;
  }
  std::size_t aim = std::min(at_ + 1, points.size() - 1);
  double left_m = distance_m(pose, points[aim]);
  while (aim + 1 < points.size() && aim < way_.clear_to && left_m < look_ahead_m) {
    left_m += geo::distance_m(points[aim], points[aim + 1]);
    ++aim;
  }
  for (std::size_t i = aim; i + 1 < points.size(); ++i) left_m += geo::distance_m(points[i], points[i + 1]);
  if (aim + 1 == points.size() && distance_m(pose, points.back()) < arrived_m) {
    has_arrived_ = way_.is_to_the_end;
    return {};
  }
  double const to_aim = geo::wrap_pi(std::atan2(points[aim].y() - pose.y, points[aim].x() - pose.x) - pose.yaw);
  double const off = geo::wrap_pi(free_bearing(to_aim, distance_m(pose, points[aim]), room));
  constexpr double creep_m = 0.02;  // so that braking ends at the goal, not before it
  double const braked = way_.is_to_the_end
                            ? std::sqrt(2.0 * limits_.acceleration_m_s2 * std::max(left_m - arrived_m / 2.0, creep_m))
                            : most_m_s;
  double const ahead = std::abs(off) > turn_first_rad ? 0.0 : std::cos(off) * std::min(most_m_s, braked);
  return {ahead, turn_gain * off};
}

}  // namespace lapwing::robot
