#pragma once

#include <optional>
#include <string_view>

#include "base/error.hpp"
#include "slam/mapper.hpp"

namespace lapwing::slam {

/// How it came to be known where on the map a further drive begins.
enum class Beginning {
  goes_on,  ///< its odometry goes on where that of the last drive ended, and its first scan fits there
  told,
  found,  ///< searched for on the whole map
};
[[nodiscard]] std::string_view to_string(Beginning beginning);

struct ResumedLog {
  Mapping mapping;
  Beginning beginning = Beginning::goes_on;
};

/// Goes on with a mapping that ended, by a further drive of the robot: in the same frame, as if it had never ended.
/// `start`: of the log's first scan, on the map; nothing: it goes on where the last drive ended, or is searched for.
/// The same result on any number of threads. Errors (invalid_input): the log has no scan, or few readings; what is told
/// does not fit; it is found nowhere on the map, or contradicts it where it is found.
[[nodiscard]] base::Result<ResumedLog> resume_log(SavedMap saved, ScanLog const& log, std::optional<Pose2> const& start,
                                                  ForEach const& for_each, Progress const& progress);

}  // namespace lapwing::slam
