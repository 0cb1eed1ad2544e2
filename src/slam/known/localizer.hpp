#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "slam/known/find_start.hpp"
#include "slam/known/known_map.hpp"
#include "slam/known/lay_on_map.hpp"
#include "slam/match/odometry_noise.hpp"

namespace lapwing::slam {

/// Follows a robot on a map that is known and does not change.
class Localizer {
 public:
  Localizer(KnownMap const& map, Pose2 const& start, Pose2 const& odometry)
      : map_(map), pose_(start), odometry_(odometry) {}

  /// By odometry, then downhill; where that fits badly, the best of all poses around.
  Laid follow(Frame const& frame, Pose2 const& odometry);

 private:
  KnownMap const& map_;
  Pose2 pose_;
  Pose2 odometry_;
  OdometryNoise noise_;
};

/// A scan of a log on a known map.
struct LocalizedScan {
  Pose2 pose;
  double fit = 0.0;
  bool is_lost = true;  ///< nobody knows where the robot was; the pose means nothing
};

struct Localization {
  std::vector<LocalizedScan> scans;  ///< one each of the log
  std::optional<FoundStart> start;   ///< where it was searched for
  int times_lost = 0;                ///< after it had been found
};

/// Where the robot of a log was on the map. `start`: of the first scan; nothing: it is searched for. Where the scans
/// fit badly over a metre of the way, the robot is lost from where that began, and is searched for again.
[[nodiscard]] Localization localize_log(KnownMap const& map, ScanLog const& log, std::optional<Pose2> const& start,
                                        FrameOptions const& options,
                                        std::function<void(std::string_view stage, double share)> const& progress);

}  // namespace lapwing::slam
