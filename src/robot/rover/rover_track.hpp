#pragma once

#include <optional>

#include "base/clock_offset.hpp"
#include "mavlink/codec/messages.hpp"
#include "slam/log/pose_track.hpp"
#include "slam/pose2.hpp"

namespace lapwing::robot::rover {

/// A rover's way by what its autopilot says of itself: LOCAL_POSITION_NED for the place and the velocity, ATTITUDE for
/// the heading. North, east, down and clockwise become x, y and counterclockwise: the x axis looks north, y west.
///
/// An estimator corrects itself: its place jumps when satellites come back, its heading when it trusts its compass
/// again. Nobody has moved then, and odometry must not tell a map that somebody did: a step that the velocity and the
/// turn rate do not bear out is gone by these.
class RoverTrack {
 public:
  struct Moment {
    base::TimePoint at{};  ///< of our clock
    slam::Pose2 pose = {};
    double speed_m_s = 0.0;  ///< ahead; below zero: backwards
  };

  void take(mavlink::Attitude const& attitude, base::TimePoint arrived);
  /// Whether there is a new moment: none without a heading of late.
  bool take(mavlink::LocalPosition const& position, base::TimePoint arrived);

  [[nodiscard]] std::optional<Moment> const& now() const { return now_; }
  /// At that time; where it is now, when that is seconds ago. Nothing as long as no moment is as late as that.
  [[nodiscard]] std::optional<slam::Pose2> at(base::TimePoint time) const;
  /// How often the estimator has corrected itself.
  [[nodiscard]] int corrections() const { return corrections_; }

 private:
  struct Heading {
    base::TimePoint at{};
    double yaw_rad = 0.0;
    double rate_rad_s = 0.0;
  };
  struct Raw {
    base::TimePoint at{};
    base::Duration since_boot{};
    slam::Pose2 pose = {};  ///< as it was told
    double ahead_m_s = 0.0;
    double leftwards_m_s = 0.0;
    double rate_rad_s = 0.0;
  };
  [[nodiscard]] slam::Pose2 step_between(Raw const& from, Raw const& to);

  base::ClockOffset clock_;
  std::optional<Heading> heading_;
  std::optional<Raw> raw_;
  slam::PoseTrack track_;  ///< of the last seconds
  std::optional<Moment> now_;
  int corrections_ = 0;
};

}  // namespace lapwing::robot::rover
