#pragma once

#include <filesystem>
#include <optional>

#include "apps/slam/map_logs.hpp"
#include "slam/state/saved_map.hpp"

/// The state of a mapping as a file, and what goes on from it.
namespace lapwing::apps {

/// Of a folder that `lapwing map` wrote, or the file itself.
[[nodiscard]] std::filesystem::path state_path(std::filesystem::path const& folder_or_file);

/// Errors, with the file's name: io; invalid_input: no state of a mapping, or one that is not whole.
[[nodiscard]] base::Result<slam::SavedMap> read_state_file(std::filesystem::path const& path);

/// Whether the map can go on later: it is of one drive after another, of scans that were not gathered.
[[nodiscard]] bool can_go_on(slam::Mapping const& mapping);
/// Error: io. Precondition: it can go on.
[[nodiscard]] base::Result<> write_state_file(slam::Mapping const& mapping, std::filesystem::path const& folder);

/// All drives as parts. Errors (invalid_input), with the log's name: as slam::resume_log.
[[nodiscard]] base::Result<LogsMap> resume_map(slam::SavedMap saved, std::filesystem::path const& path,
                                               slam::ScanLog log, std::optional<slam::Pose2> const& start,
                                               slam::ForEach const& for_each, slam::Progress const& progress);

}  // namespace lapwing::apps
