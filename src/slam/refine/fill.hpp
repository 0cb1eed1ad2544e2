#pragma once

#include "slam/graph.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/parallel.hpp"

namespace lapwing::slam {

struct FillOptions {
  int neighbours = 5;
  double radius_m = 4.0;
  double point_information = 250.0;
  int stride = 2;  ///< every n-th point of a scan: it has one pose to find, and hundreds of points
};

/// A scan of a log whose place is known by the graph.
struct WayPoint {
  int scan = 0;   ///< of the log
  int frame = 0;  ///< key frame that it is, or that it was taken near
  Pose2 pose;
  bool is_key = true;  ///< it is that key frame

  friend bool operator==(WayPoint const&, WayPoint const&) = default;
};
/// The key frames of a graph of one log.
[[nodiscard]] std::vector<WayPoint> way_of(Graph const& graph);
/// The last of them up to a scan, or the first.
[[nodiscard]] WayPoint const& way_point_before(std::vector<WayPoint> const& way, int scan);

/// Where each scan of the log was taken: key frames where the graph has them, every other one carried from its way
/// point by odometry and aligned to the key frames around it. `way`: ascending. Precondition: as many odometry poses as
/// scans.
[[nodiscard]] std::vector<Pose2> fill(ScanLog const& log, std::vector<Pose2> const& odometry,
                                      std::vector<WayPoint> const& way, Graph const& graph,
                                      FrameOptions const& frame_options, FillOptions const& options,
                                      ForEach const& for_each);

/// The same by odometry alone, for scans that show too little to be aligned: what the key frames' poses differ by from
/// odometry is shared out over the scans between them.
[[nodiscard]] std::vector<Pose2> spread_over_scans(std::vector<Pose2> const& odometry, Graph const& graph);

}  // namespace lapwing::slam
