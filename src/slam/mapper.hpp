#pragma once

#include <functional>
#include <string_view>

#include "slam/front_end.hpp"
#include "slam/graph.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/loops/loop_closer.hpp"
#include "slam/refine/fill.hpp"
#include "slam/refine/joint.hpp"

namespace lapwing::slam {

struct MapperOptions {
  FrameOptions frame;
  FrontEndOptions front_end;
  LoopOptions loops;
  JointOptions joint;
  FillOptions fill;
};

/// What a log came to.
struct Mapping {
  Graph graph;
  std::vector<Pose2> trajectory;  ///< one a scan of the log
  LoopCloser::Counts loops;
  std::vector<LoopRecord> loop_records;
};

/// `share`: how much of the work is done, 0 to 1.
using Progress = std::function<void(std::string_view stage, double share)>;

/// Maps a log: follows the robot, closes loops as they come, then refines everything together. The same result on any
/// number of threads.
[[nodiscard]] Mapping map_log(ScanLog const& log, MapperOptions const& options, ForEach const& for_each,
                              Progress const& progress);

}  // namespace lapwing::slam
