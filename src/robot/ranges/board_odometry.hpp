#pragma once

#include <optional>

#include "robot/sensors/sensor_interface.hpp"
#include "slam/log/pose_track.hpp"

namespace lapwing::robot {

/// Where a board's body was lately, in a frame that drifts, so that scans find where they were taken: the last seconds
/// of what the sensor interface makes of its readings.
class BoardOdometry {
 public:
  /// `begin`: where its board's own frame begins; a board that has started anew stands where it was.
  explicit BoardOdometry(firmware::Description const& description, slam::Pose2 const& begin = {})
      : begin_(begin), now_(begin), sensors_(description) {}

  /// What the readings say of the body; nothing for the first ones and for those that are not newer than the last.
  std::optional<Sensed> feed(firmware::Readings const& readings);

  /// By the newest readings.
  [[nodiscard]] slam::Pose2 const& pose() const { return now_; }
  /// By the board's clock, between the readings around it; by the newest ones where they do not reach so far.
  [[nodiscard]] slam::Pose2 at(firmware::Time time) const { return track_.at(time).value_or(now_); }

 private:
  slam::Pose2 begin_;
  slam::Pose2 now_;
  SensorInterface sensors_;
  slam::PoseTrack track_;  ///< of the last seconds
};

}  // namespace lapwing::robot
