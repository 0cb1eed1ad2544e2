#pragma once

#include <iterator>
#include <vector>

#include "slam/scan/frame.hpp"

namespace lapwing::slam {

struct GatherOptions {
  int few_readings = 40;       ///< a log whose scans have fewer in the middle of all is gathered
  double least_m = 1.0;        ///< driven for one key frame
  double most_m = 2.5;         ///< even if too little was seen on the way
  double most_turn_rad = 1.0;  ///< beyond, odometry smears what was seen first
  int enough_points = 120;

  // In place of those of the other parts, where scans are gathered.
  int submap_frames = 5;
  int query_frames = 4;
  int least_matches = 40;
  double least_score = 0.45;
  double odometry_spread = 0.4;  ///< a few beams must not overrule wheels that are right
  double point_information = 150.0;
};

/// Whether one scan of that sensor shows too little to know a place by.
[[nodiscard]] inline bool is_sparse(Sensor const& sensor, GatherOptions const& options = {}) {
  return std::ssize(sensor.bearings_rad) < options.few_readings;
}

/// A smooth wall sends sound back to a sonar that it is met no more aslant by than this, its cone included.
inline constexpr double heard_aslant_rad = 0.5;

/// Joins scans of few beams along odometry into frames with enough points to match: what a laser sees at once, sonars
/// or single rangers see over a metre or two of the way (as Zhou et al. 2022 do).
class Gatherer {
 public:
  Gatherer(GatherOptions const& options, FrameOptions const& frame_options)
      : options_(options), frame_options_(frame_options) {}

  /// Takes in one scan more, if the robot has moved since the last one.
  void add(Scan const& scan, Sensor const& sensor, Pose2 const& odometry);
  /// Whether it is time for a key frame.
  [[nodiscard]] bool is_due() const;
  [[nodiscard]] bool is_empty() const { return points_.empty(); }
  /// What was gathered, in the robot's frame at the last scan; then it begins anew.
  [[nodiscard]] Frame take();

 private:
  struct Point {
    Eigen::Vector2d at;    ///< in odometry's frame
    Eigen::Vector2d from;  ///< the sensor's place
  };

  GatherOptions options_;
  FrameOptions frame_options_;
  std::vector<Point> points_;
  bool has_begun_ = false;
  bool hears_cones_ = false;
  Pose2 last_;  ///< scan that was taken in
  Pose2 now_;
  double path_m_ = 0.0;
  double turn_rad_ = 0.0;
};

}  // namespace lapwing::slam
