#pragma once

#include <cstddef>
#include <optional>

#include "slam/known/known_map.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/scan/frame.hpp"

namespace lapwing::slam {

struct FoundStart {
  Pose2 pose;             ///< of the scan that was asked for
  double score = 0.0;     ///< mean over the points, 1 when every one lies on a wall
  double rival = 0.0;     ///< of the best pose elsewhere, or what bounds it
  std::size_t scans = 0;  ///< that were needed
};

/// Where on the map the robot was at a scan, searched everywhere and in every direction: with that scan alone, and with
/// three, ten and thirty of those that follow a step apart, joined by odometry, until they fit and no other place does
/// nearly as well. Nothing: no place fits, or several do.
[[nodiscard]] std::optional<FoundStart> find_start(KnownMap const& map, ScanLog const& log, std::size_t scan,
                                                   FrameOptions const& options);

}  // namespace lapwing::slam
