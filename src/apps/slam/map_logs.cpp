#include "apps/slam/map_logs.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "apps/slam/map_report.hpp"
#include "base/files/replace_file.hpp"

namespace lapwing::apps {

namespace {

using Json = nlohmann::ordered_json;

std::vector<slam::TimedPose> poses_of(LogsMap const& made, slam::MergedLog const& part) {
  std::vector<slam::TimedPose> poses;
  for (auto i = part.first_scan; i < part.first_scan + part.scans; ++i)
    poses.push_back({made.log.scans[i].time, made.mapping.trajectory[i]});
  return poses;
}

LogsMap of_one(std::filesystem::path const& path, slam::ScanLog log, slam::Mapping mapping) {
  auto const& frames = mapping.graph.frames;
  slam::MergedLog const whole{.scans = log.scans.size(),
                              .key_frames = static_cast<int>(frames.size()),
                              .path_m = frames.empty() ? 0.0 : frames.back().path_m};
  mapping.memory.drives.back().name = path.filename().string();
  return {.log = std::move(log), .mapping = std::move(mapping), .parts = {{path.string(), whole}}};
}

}  // namespace

base::Result<LogsMap> map_logs(std::vector<std::filesystem::path> const& paths, std::vector<RecordedLog> recorded,
                               slam::MapperOptions const& options, slam::ForEach const& for_each,
                               slam::Progress const& progress) {
  auto const count = recorded.size();
  // Merging takes about as long as one of the logs did.
  auto const stages = static_cast<double>(count == 1 ? 1 : count + 1);
  std::size_t stage_number = 0;
  auto const tell = [&](std::string_view stage, double share) {
    progress(stage, (static_cast<double>(stage_number) + share) / stages);
  };
  std::vector<slam::MappedLog> mapped;
  for (; stage_number < count; ++stage_number) {
    auto& log = recorded[stage_number].log;
    auto mapping = slam::map_log(log, options, for_each, tell);
    if (count == 1) return of_one(paths[0], std::move(log), std::move(mapping));
    mapped.push_back({paths[stage_number].string(), std::move(log), std::move(mapping)});
  }
  auto merged = slam::merge_maps(std::move(mapped), options, for_each, tell);
  if (!merged) return std::unexpected(merged.error());
  LogsMap made{.log = std::move(merged->log), .mapping = std::move(merged->mapping), .parts = {}};
  for (std::size_t i = 0; i < count; ++i) made.parts.push_back({paths[i].string(), merged->logs[i]});
  return made;
}

double path_m(std::vector<LogPart> const& parts) {
  double sum = 0.0;
  for (auto const& part : parts) sum += part.merged.path_m;
  return sum;
}

std::vector<slam::TimedPose> in_time_order(LogsMap const& made) {
  std::vector<slam::TimedPose> poses;
  for (auto const& part : made.parts) {
    auto const some = poses_of(made, part.merged);
    poses.insert(poses.end(), some.begin(), some.end());
  }
  std::ranges::stable_sort(poses, {}, &slam::TimedPose::time);
  return poses;
}

Json parts_json(std::vector<LogPart> const& parts) {
  auto list = Json::array();
  for (auto const& [name, merged] : parts)
    list.push_back({{"log", name},
                    {"scans", merged.scans},
                    {"key_frames", merged.key_frames},
                    {"path_m", merged.path_m},
                    {"closures", merged.closures}});
  return list;
}

Json loops_json(LogsMap const& made) {
  auto const& mapping = made.mapping;
  auto const seconds = [&](int frame) {
    return made.log.scans[static_cast<std::size_t>(mapping.graph.frames[frame].scan)].time.count();
  };
  auto list = Json::array();
  for (auto const& r : mapping.loop_records)
    list.push_back({{"query", r.query},
                    {"target", r.target},
                    {"query_s", seconds(r.query)},
                    {"target_s", seconds(r.target)},
                    {"window_m", r.window.reach_m},
                    {"window_rad", r.window.reach_rad},
                    {"score", r.score},
                    {"rival", r.rival},
                    {"conflict", r.conflict},
                    {"matches", r.matches},
                    {"shift_m", r.shift_m},
                    {"turn_rad", r.turn_rad},
                    {"witnesses", r.witnesses},
                    {"deviations", r.deviations},
                    {"contradiction", r.contradiction},
                    {"was_contradiction", r.was_contradiction},
                    {"is_late", r.is_late},
                    {"verdict", to_string(r.verdict)}});
  return list;
}

base::Result<> write_trajectories(LogsMap const& made, std::filesystem::path const& folder) {
  for (std::size_t i = 0; i < made.parts.size(); ++i) {
    auto const name = made.parts.size() == 1 ? "trajectory.tum" : fmt::format("trajectory-{}.tum", i + 1);
    auto done = base::replace_file(folder / name, tum_text(poses_of(made, made.parts[i].merged)));
    if (!done) return done;
  }
  return {};
}

}  // namespace lapwing::apps
