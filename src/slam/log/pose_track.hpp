#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "slam/pose2.hpp"

namespace lapwing::slam {

/// Where a robot was by its odometry.
class PoseTrack {
 public:
  struct Moment {
    std::chrono::nanoseconds stamp{};
    Pose2 pose = {};
  };
  PoseTrack() = default;
  /// In any order; what is no number is left out. Of two that have one stamp the first counts.
  explicit PoseTrack(std::vector<Moment> moments);

  /// While the robot drives. One that is not newer than the last begins anew: its clock was set, or its driver started
  /// again. Precondition: its pose is of numbers.
  void add(Moment const& moment);
  void forget_before(std::chrono::nanoseconds stamp);

  /// Between two moments; up to a tenth of a second before the first and after the last it is where it was there, and
  /// beyond nobody knows.
  [[nodiscard]] std::optional<Pose2> at(std::chrono::nanoseconds stamp) const;
  [[nodiscard]] bool is_empty() const { return moments_.empty(); }

 private:
  std::vector<Moment> moments_;
};

}  // namespace lapwing::slam
