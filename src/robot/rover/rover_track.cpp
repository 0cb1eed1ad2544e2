#include "robot/rover/rover_track.hpp"

#include <cmath>

#include "geo/position.hpp"

namespace lapwing::robot::rover {

using namespace std::chrono_literals;
using slam::Pose2;

namespace {

/// A heading that is older tells nothing of now.
constexpr base::Duration heading_is_old = 300ms;
/// Behind a gap nobody can say what was driven and what was corrected: it is believed.
constexpr base::Duration gap = 1s;
constexpr base::Duration remembered = 3s;
/// How far a step may be from what the velocity gives: the filter's noise and what a wheel can do in a tenth of a
/// second; a half more of the step itself.
constexpr double odd_step_m = 0.15;
constexpr double odd_turn_rad = 0.15;

}  // namespace

void RoverTrack::take(mavlink::Attitude const& attitude, base::TimePoint arrived) {
  if (!attitude.yaw_rad) return;
  heading_ = Heading{.at = clock_.here(attitude.since_boot, arrived),
                     .yaw_rad = -*attitude.yaw_rad,
                     .rate_rad_s = -attitude.yaw_rate_rad_s.value_or(0.0)};
}

bool RoverTrack::take(mavlink::LocalPosition const& position, base::TimePoint arrived) {
  auto const at = clock_.here(position.since_boot, arrived);
  if (!position.position_m || !position.velocity_m_s || !heading_) return false;
  base::Duration const since = at - heading_->at;
  if (since > heading_is_old || since < -heading_is_old) return false;
  double const yaw = geo::wrap_pi(heading_->yaw_rad + heading_->rate_rad_s * base::to_seconds(since));
  double const x_m_s = position.velocity_m_s->north;
  double const y_m_s = -position.velocity_m_s->east;
  Raw const raw{.at = at,
                .since_boot = position.since_boot,
                .pose = {position.position_m->north, -position.position_m->east, yaw},
                .ahead_m_s = x_m_s * std::cos(yaw) + y_m_s * std::sin(yaw),
                .leftwards_m_s = y_m_s * std::cos(yaw) - x_m_s * std::sin(yaw),
                .rate_rad_s = heading_->rate_rad_s};
  auto pose = now_ ? now_->pose : raw.pose;
  // An autopilot that has started anew begins a new frame where it stands.
  bool const goes_on = raw_ && raw.at > raw_->at && raw.since_boot > raw_->since_boot;
  if (goes_on) pose = pose * step_between(*raw_, raw);
  if (!goes_on) track_ = {};
  track_.add({.stamp = at.time_since_epoch(), .pose = pose});
  track_.forget_before(at.time_since_epoch() - remembered);
  now_ = Moment{.at = at, .pose = pose, .speed_m_s = raw.ahead_m_s};
  raw_ = raw;
  return true;
}

Pose2 RoverTrack::step_between(Raw const& from, Raw const& to) {
  auto const told = slam::between(from.pose, to.pose);
  if (to.at - from.at > gap) return told;
  double const seconds = base::to_seconds(to.at - from.at);
  double const turn = 0.5 * (from.rate_rad_s + to.rate_rad_s) * seconds;
  double const ahead = 0.5 * (from.ahead_m_s + to.ahead_m_s) * seconds;
  double const leftwards = 0.5 * (from.leftwards_m_s + to.leftwards_m_s) * seconds;
  bool const is_odd =
      std::hypot(told.x - ahead, told.y - leftwards) > odd_step_m + 0.5 * std::hypot(ahead, leftwards) ||
      std::abs(geo::wrap_pi(told.yaw - turn)) > odd_turn_rad + 0.5 * std::abs(turn);
  if (!is_odd) return told;
  ++corrections_;
  return {ahead * std::cos(turn / 2) - leftwards * std::sin(turn / 2),
          ahead * std::sin(turn / 2) + leftwards * std::cos(turn / 2), turn};
}

std::optional<Pose2> RoverTrack::at(base::TimePoint time) const {
  if (!now_ || now_->at < time) return std::nullopt;
  return track_.at(time.time_since_epoch()).value_or(now_->pose);
}

}  // namespace lapwing::robot::rover
