#include "apps/slam/resume_map.hpp"

#include <algorithm>
#include <utility>

#include "base/assert.hpp"
#include "base/files/replace_file.hpp"
#include "slam/state/resume.hpp"
#include "slam/state/state_file.hpp"

namespace lapwing::apps {

namespace {

namespace fs = std::filesystem;

/// Every scan so far with its time. Of earlier drives only the key frames' readings are known, and of the last one all.
slam::ScanLog whole_log(slam::Mapping const& mapping, slam::ScanLog log) {
  auto const& memory = mapping.memory;
  auto const first = memory.past.size() - log.scans.size();
  slam::ScanLog whole{.sensors = memory.seen.sensors, .scans = {}};
  for (std::size_t i = 0; i < first; ++i)
    whole.scans.push_back({.time = memory.past[i].time, .odometry = {}, .ranges_m = {}});
  for (std::size_t k = 0; k < memory.seen.scans.size(); ++k)
    if (auto const scan = static_cast<std::size_t>(mapping.graph.frames[k].scan); scan < first)
      whole.scans[scan] = memory.seen.scans[k];
  auto const known = static_cast<int>(whole.sensors.size());
  for (auto& sensor : log.sensors) whole.sensors.push_back(std::move(sensor));
  for (auto& scan : log.scans) {
    scan.sensor += known;
    whole.scans.push_back(std::move(scan));
  }
  return whole;
}

/// The drives as the parts of one log, with the loops that join each with those before.
std::vector<LogPart> parts_of(slam::Mapping const& mapping) {
  std::vector<LogPart> parts;
  std::size_t first = 0;
  for (auto const& drive : mapping.memory.drives) {
    auto const scans = static_cast<std::size_t>(drive.scans);
    parts.push_back(
        {drive.name, {.first_scan = first, .scans = scans, .key_frames = drive.key_frames, .path_m = drive.path_m}});
    first += scans;
  }
  auto const drive_of = [&](int frame) {
    auto const scan = static_cast<std::size_t>(mapping.graph.frames[static_cast<std::size_t>(frame)].scan);
    return std::ranges::find_if(parts,
                                [&](LogPart const& part) { return scan < part.merged.first_scan + part.merged.scans; });
  };
  for (auto const& constraint : mapping.graph.constraints) {
    auto const from = drive_of(constraint.from);
    auto const to = drive_of(constraint.to);
    if (constraint.is_loop && from != to) ++std::max(from, to)->merged.closures;
  }
  return parts;
}

}  // namespace

fs::path state_path(fs::path const& folder_or_file) {
  return fs::is_directory(folder_or_file) ? folder_or_file / "mapping.state" : folder_or_file;
}

base::Result<slam::SavedMap> read_state_file(fs::path const& path) {
  auto const bytes = read_file(path);
  if (!bytes) return std::unexpected(bytes.error());
  auto saved = slam::read_state(*bytes);
  if (!saved) return in_file(path, saved.error());
  return saved;
}

bool can_go_on(slam::Mapping const& mapping) {
  return !mapping.memory.drives.empty() && !mapping.graph.frames.empty() && !mapping.memory.kind.is_sparse;
}

base::Result<> write_state_file(slam::Mapping const& mapping, fs::path const& folder) {
  LAPWING_ASSERT(can_go_on(mapping));
  return base::replace_file(folder / "mapping.state", slam::write_state(mapping.graph, mapping.memory));
}

base::Result<LogsMap> resume_map(slam::SavedMap saved, fs::path const& path, slam::ScanLog log,
                                 std::optional<slam::Pose2> const& start, slam::ForEach const& for_each,
                                 slam::Progress const& progress) {
  auto resumed = slam::resume_log(std::move(saved), log, start, for_each, progress);
  if (!resumed) return in_file(path, resumed.error());
  auto& mapping = resumed->mapping;
  mapping.memory.drives.back().name = path.filename().string();
  LogsMap made{.log = whole_log(mapping, std::move(log)),
               .mapping = {},
               .parts = parts_of(mapping),
               .beginning = to_string(resumed->beginning)};
  made.mapping = std::move(mapping);
  return made;
}

}  // namespace lapwing::apps
