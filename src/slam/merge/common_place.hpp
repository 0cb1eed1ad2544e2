#pragma once

#include <optional>

#include "slam/known/known_map.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

/// A scan of a drive, and where on a map of another drive it was taken.
struct CommonPlace {
  int scan = 0;
  Pose2 pose;         ///< on the map
  int witnesses = 0;  ///< other scans that say the same of how the two maps lie
};

/// Where a drive whose odometry does not drift was on a map of another: of all places at which its scans fit, the one
/// that most of the others agree with. Nothing: that are fewer than `least_witnesses`, or less than half of
/// all those places.
[[nodiscard]] std::optional<CommonPlace> find_common_place(KnownMap const& map, ScanLog const& drive,
                                                           int least_witnesses, FrameOptions const& options);

}  // namespace lapwing::slam
