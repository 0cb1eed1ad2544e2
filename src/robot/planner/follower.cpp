#include "robot/planner/follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr double look_ahead_m = 0.4;
constexpr double arrived_m = 0.12;
constexpr double turn_first_rad = 0.6;  ///< farther to the side than this, the robot turns where it stands
constexpr double turn_gain = 2.0;
constexpr double looks_back_rad = 2.8;  ///< a beam that far from ahead

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
  double const brakes_m = std::max(0.0, goes_back ? room.behind_m : room.ahead_m);
  double const stops_m_s = std::sqrt(2.0 * limits_.acceleration_m_s2 * brakes_m);
  double const most_m_s = goes_back ? std::max(way_.speed_m_s, -stops_m_s) : std::min(way_.speed_m_s, stops_m_s);
  Motion wanted;
  if (way_.yaw_rad) {
    double const off = geo::wrap_pi(*way_.yaw_rad - pose.yaw);
    wanted = {std::abs(off) > turn_first_rad ? 0.0 : most_m_s, turn_gain * off};
  } else if (!way_.points.empty() && !has_arrived_) {
    wanted = along(pose, most_m_s);
  }
  wanted.turn_rad_s = std::clamp(wanted.turn_rad_s, -limits_.turn_rad_s, limits_.turn_rad_s);
  return wanted;
}

Motion Follower::along(slam::Pose2 const& pose, double most_m_s) {
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
  double const off = geo::wrap_pi(std::atan2(points[aim].y() - pose.y, points[aim].x() - pose.x) - pose.yaw);
  constexpr double creep_m = 0.02;  // so that braking ends at the goal, not before it
  double const braked = way_.is_to_the_end
                            ? std::sqrt(2.0 * limits_.acceleration_m_s2 * std::max(left_m - arrived_m / 2.0, creep_m))
                            : most_m_s;
  double const ahead = std::abs(off) > turn_first_rad ? 0.0 : std::cos(off) * std::min(most_m_s, braked);
  return {ahead, turn_gain * off};
}

Room room_of(slam::Scan const& scan, slam::Sensor const& sensor, Limits const& limits, double most_m) {
  // Less than ways keep off: where those just fit, the noise of a range must not hold the robot up.
  double const keep_m = limits.radius_m + 0.4 * limits.safe_distance_m;
  bool const looks_back =
      std::ranges::any_of(sensor.bearings_rad, [](double bearing) { return std::abs(bearing) > looks_back_rad; });
  Room room{.ahead_m = most_m, .behind_m = looks_back ? most_m : 0.0};
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    double const range_m = scan.ranges_m[i];
    if (!(range_m > 0.0) || range_m >= sensor.no_return_m) continue;
    double const bearing = sensor.bearings_rad[i];
    double const ahead = range_m * std::cos(bearing) + sensor.mount_m.x();
    double const aside = range_m * std::sin(bearing) + sensor.mount_m.y();
    if (std::abs(aside) >= keep_m) continue;
    double& way_m = ahead > 0.0 ? room.ahead_m : room.behind_m;
    way_m = std::min(way_m, std::abs(ahead) - std::sqrt(keep_m * keep_m - aside * aside));
  }
  return room;
}

}  // namespace lapwing::robot
