#pragma once

#include "slam/mapper_options.hpp"

namespace lapwing::slam {

/// What a robot brings along.
struct RobotKind {
  bool has_odometry = true;  ///< without, the scans alone say how it moves
  bool has_times = true;     ///< without, nobody knows how fast it went
  bool is_sparse = false;    ///< so few readings a scan that several are joined into one
};

/// What a log looks like.
[[nodiscard]] RobotKind kind_of(ScanLog const& log, GatherOptions const& options);

/// The options for that robot. Key frames that were gathered are a metre and more apart, where those of a laser are
/// two decimetres, so that all counts of key frames become smaller.
[[nodiscard]] MapperOptions options_for(RobotKind const& kind, MapperOptions options);

}  // namespace lapwing::slam
