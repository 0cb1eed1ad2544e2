#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/slam/recorded_log.hpp"
#include "slam/merge/merge_maps.hpp"
#include "slam/relations.hpp"

/// One map of one log or of several, and what is written of it.
namespace lapwing::apps {

struct LogPart {
  std::string name;
  slam::MergedLog merged;
};
struct LogsMap {
  slam::ScanLog log;  ///< of several one after another
  slam::Mapping mapping;
  std::vector<LogPart> parts;
  std::string_view beginning = {};  ///< of a mapping that went on: how it was known where the drive begins
};

/// Errors (invalid_input): of several logs one cannot be merged with the others. Preconditions: there is a log, and a
/// path for each.
[[nodiscard]] base::Result<LogsMap> map_logs(std::vector<std::filesystem::path> const& paths,
                                             std::vector<RecordedLog> recorded, slam::MapperOptions const& options,
                                             slam::ForEach const& for_each, slam::Progress const& progress);

/// Driven in all.
[[nodiscard]] double path_m(std::vector<LogPart> const& parts);
[[nodiscard]] std::vector<slam::TimedPose> in_time_order(LogsMap const& made);
[[nodiscard]] nlohmann::ordered_json parts_json(std::vector<LogPart> const& parts);
[[nodiscard]] nlohmann::ordered_json loops_json(LogsMap const& made);

/// `trajectory.tum`; of several logs `trajectory-1.tum` and so on, in the order in which they were named.
[[nodiscard]] base::Result<> write_trajectories(LogsMap const& made, std::filesystem::path const& folder);

}  // namespace lapwing::apps
