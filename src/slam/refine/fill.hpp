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

/// Where each scan of the log was taken: key frames where the graph has them, every other one carried from its key
/// frame by odometry and aligned to the key frames around it. Precondition: as many odometry poses as scans.
[[nodiscard]] std::vector<Pose2> fill(ScanLog const& log, std::vector<Pose2> const& odometry, Graph const& graph,
                                      FrameOptions const& frame_options, FillOptions const& options,
                                      ForEach const& for_each);

/// The same by odometry alone, for scans that show too little to be aligned: what the key frames' poses differ by from
/// odometry is shared out over the scans between them.
[[nodiscard]] std::vector<Pose2> spread_over_scans(std::vector<Pose2> const& odometry, Graph const& graph);

}  // namespace lapwing::slam
