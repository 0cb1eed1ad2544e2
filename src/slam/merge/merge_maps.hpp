#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "slam/mapper.hpp"

namespace lapwing::slam {

/// A log and the map that was made of it alone.
struct MappedLog {
  std::string name;  ///< as messages call it
  ScanLog log;
  Mapping mapping;
};

/// What became of one of the logs. Scans and key frames of all logs are counted on from one to the next.
struct MergedLog {
  std::size_t first_scan = 0;
  std::size_t scans = 0;
  int key_frames = 0;
  double path_m = 0.0;  ///< driven
  int closures = 0;     ///< loops that join it with logs merged before; none for the first
};

/// Several logs as one.
struct MergedMaps {
  ScanLog log;
  Mapping mapping;  ///< in the frame of the first log's map
  std::vector<MergedLog> logs;
};

/// Makes one map of those of several drives through one building, in any order: each is laid on what is merged already,
/// where its scans fit, joined by loops that are believed for the same reasons as those of one drive, and then all key
/// frames are aligned at once. The same result on any number of threads. Errors (invalid_input), with the log's name:
/// it shares no place with the others; what it saw contradicts them; its scans have few readings. Precondition: there
/// is a log.
[[nodiscard]] base::Result<MergedMaps> merge_maps(std::vector<MappedLog> logs, MapperOptions const& options,
                                                  ForEach const& for_each, Progress const& progress);

}  // namespace lapwing::slam
