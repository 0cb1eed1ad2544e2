#include "slam/match/odometry_watch.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::slam {
namespace {

/// Between what slow odometry says, of which several scans know the same.
constexpr LogTime usual(0.3);

/// Whether no robot moves so within that time.
bool is_leap(Pose2 const& motion, LogTime elapsed) {
  constexpr double most_m_s = 3.0;
  constexpr double most_rad_s = 4.0;
  constexpr double least_s = 0.2;  // stamps of recordings come in bunches
  auto const seconds = std::max(least_s, elapsed.count());
  return std::hypot(motion.x, motion.y) > most_m_s * seconds || std::abs(motion.yaw) > most_rad_s * seconds;
}

}  // namespace

bool is_rest(Pose2 const& motion) {
  return std::hypot(motion.x, motion.y) < 0.05 && std::abs(motion.yaw) < 0.03;
}

void OdometryWatch::follow(Pose2 const& odometry, LogTime elapsed) {
  has_leapt_ = has_leapt_ || (!is_first_ && is_leap(between(odometry_, odometry), elapsed));
  if (is_first_ || !is_rest(between(rest_, odometry))) {
    rest_ = odometry;
    still_ = LogTime(0.0);
    patience_ = usual;
  } else {
    still_ += elapsed;
  }
  odometry_ = odometry;
  is_first_ = false;
}

void OdometryWatch::found_still(bool is_sure) {
  constexpr LogTime longest(1.0);  // in which a robot does not get out of sight of where it was
  still_ = LogTime(0.0);
  patience_ = is_sure ? LogTime::max() : std::min(longest, 2.0 * patience_);
}

bool OdometryWatch::is_suspiciously_still() const {
  return still_ > patience_;
}

}  // namespace lapwing::slam
