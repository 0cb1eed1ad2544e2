#pragma once

#include <deque>
#include <optional>

#include "robot/sensors/sensor_interface.hpp"
#include "slam/pose2.hpp"

namespace lapwing::robot {

/// Where a board's body was lately, in a frame that drifts, so that scans find where they were taken: the last seconds
/// of what the sensor interface makes of its readings.
class BoardOdometry {
 public:
  /// `begin`: where its board's own frame begins; a board that has started anew stands where it was.
  explicit BoardOdometry(firmware::Description const& description, slam::Pose2 const& begin = {})
      : begin_(begin), sensors_(description) {}

  /// What the readings say of the body; nothing for the first ones and for those that are not newer than the last.
  std::optional<Sensed> feed(firmware::Readings const& readings);

  /// By the newest readings.
  [[nodiscard]] slam::Pose2 pose() const { return samples_.empty() ? begin_ : samples_.back().pose; }
  /// By the board's clock, between the readings around it; the nearest one before the first and behind the last.
  [[nodiscard]] slam::Pose2 at(firmware::Time time) const;

 private:
  struct Sample {
    firmware::Time time{};
    slam::Pose2 pose = {};
  };
  slam::Pose2 begin_;
  SensorInterface sensors_;
  std::deque<Sample> samples_;
};

}  // namespace lapwing::robot
