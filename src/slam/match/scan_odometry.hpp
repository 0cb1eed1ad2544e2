#pragma once

#include <deque>
#include <optional>

#include "slam/log/scan_log.hpp"
#include "slam/match/local_grid.hpp"

namespace lapwing::slam {

/// Odometry made of scans, for robots that tell none: each scan is searched around where the robot would be if it went
/// on as before, and aligned to some that were taken shortly before. It drifts as wheels do.
class ScanOdometry {
 public:
  /// Where the robot is now, in a frame that begins at its first scan.
  [[nodiscard]] Pose2 follow(Frame const& frame, LogTime time);

 private:
  struct Found {
    Pose2 pose;
    Pose2 predicted;  ///< around which it was found
  };
  [[nodiscard]] Found search(Frame const& frame, Pose2 const& by_speed) const;
  void keep(Frame const& frame);
  void note_speed(LogTime now);

  struct Seen {
    Frame frame;
    Pose2 pose;
  };
  std::deque<Seen> last_;
  LocalGrid grid_;
  struct Passed {
    LogTime time;
    Pose2 pose;
  };
  std::optional<Passed> since_;  ///< where the speed was measured last
  LogTime time_{0.0};            ///< of the last scan
  Pose2 pose_;
  Pose2 step_;                                       ///< from the scan before to the last one
  Eigen::Vector3d speed_ = Eigen::Vector3d::Zero();  ///< in the robot's frame, a second
};

}  // namespace lapwing::slam
