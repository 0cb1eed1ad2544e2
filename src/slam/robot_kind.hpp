#pragma once

#include "slam/mapper_options.hpp"

namespace lapwing::slam {

/// What a robot brings along.
struct RobotKind {
  bool has_odometry = true;  ///< without, the scans alone say how it moves
  bool has_times = true;     ///< without, nobody knows how fast it went
  bool is_sparse = false;    ///< so few readings a scan that several are joined into one
  /// Between scans of a robot that moves, in the middle of all; key frames cannot be nearer to each other.
  double scan_step_m = 0.0;
};

/// What a log looks like.
[[nodiscard]] RobotKind kind_of(ScanLog const& log, GatherOptions const& options);

/// The options for that robot. Key frames that were gathered are a metre and more apart, as are those of logs that keep
/// few of the scans, where those of a laser are two decimetres, so that all counts of key frames become smaller.
[[nodiscard]] MapperOptions options_for(RobotKind const& kind, MapperOptions options);

}  // namespace lapwing::slam
