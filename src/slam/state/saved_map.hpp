#pragma once

#include <string>
#include <vector>

#include "slam/front_end.hpp"
#include "slam/graph.hpp"
#include "slam/log/scan_log.hpp"
#include "slam/loops/loop_closer.hpp"
#include "slam/mapper_options.hpp"
#include "slam/robot_kind.hpp"

namespace lapwing::slam {

/// A scan that is no key frame, or is none any more: carried along by the key frame that it was taken near.
struct PastScan {
  LogTime time{0.0};
  int frame = 0;   ///< of the graph
  Pose2 in_frame;  ///< the scan's pose as that key frame sees it

  friend bool operator==(PastScan const&, PastScan const&) = default;
};

struct PastDrive {
  std::string name;  ///< of its log; for people
  int scans = 0;
  int key_frames = 0;  ///< when it ended; a later drive may have let go of some
  double path_m = 0.0;

  friend bool operator==(PastDrive const&, PastDrive const&) = default;
};

/// What a mapping must know to go on, besides its graph.
struct MapMemory {
  MapperOptions options;  ///< as they were asked for; the robot's kind changes some
  RobotKind kind;
  ScanLog seen;                ///< the scans of the graph's key frames, in their order
  std::vector<PastScan> past;  ///< one a scan of all drives; key frames count their scans by this
  std::vector<PastDrive> drives;
  LoopCounts loops;
  FrontEnd::Memory front_end;
  Pose2 odometry;      ///< of the last scan
  Pose2 key_odometry;  ///< of the last key frame
  LogTime time{0.0};   ///< of the last scan
};

/// A mapping that has ended, and can go on.
struct SavedMap {
  Graph graph;
  MapMemory memory;
};

}  // namespace lapwing::slam
