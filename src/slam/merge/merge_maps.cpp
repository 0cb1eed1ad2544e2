#include "slam/merge/merge_maps.hpp"

#include <algorithm>
#include <expected>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/assert.hpp"
#include "slam/loops/contradiction.hpp"
#include "slam/merge/common_place.hpp"
#include "slam/merge/fit_on_map.hpp"

namespace lapwing::slam {
namespace {

/// The scans that key frames are made of, with the poses that the map has for them in place of odometry.
ScanLog key_scans(MappedLog const& mapped) {
  ScanLog keys{.sensors = mapped.log.sensors, .scans = {}};
  auto const& graph = mapped.mapping.graph;
  for (int k = 0; k < graph.size(); ++k) {
    keys.scans.push_back(mapped.log.scans[static_cast<std::size_t>(graph.frames[k].scan)]);
    keys.scans.back().odometry = graph.poses[k];
  }
  return keys;
}

void append(ScanLog& all, ScanLog log) {
  auto const known = static_cast<int>(all.sensors.size());
  for (auto& sensor : log.sensors) all.sensors.push_back(std::move(sensor));
  for (auto& scan : log.scans) {
    scan.sensor += known;
    all.scans.push_back(std::move(scan));
  }
}

/// Those of several drives, as far as they bear on key frames: the fewest of them a metre counts.
RobotKind kind_of_all(std::vector<MappedLog> const& logs, GatherOptions const& options) {
  RobotKind all;
  for (auto const& mapped : logs) {
    auto const kind = kind_of(mapped.log, options);
    all.is_sparse = all.is_sparse || kind.is_sparse;
    all.scan_step_m = std::max(all.scan_step_m, kind.scan_step_m);
  }
  return all;
}

/// So many loops besides the place at which two maps were first laid upon each other.
constexpr int least_closures = 3;
/// Of the key frames taken where the other drive went.
constexpr double least_that_fits = 0.7;

double path_m(Graph const& graph) {
  return graph.frames.empty() ? 0.0 : graph.frames.back().path_m;
}

class Merger {
 public:
  Merger(std::vector<MappedLog>& logs, MapperOptions const& options, ForEach const& for_each)
      : logs_(logs), options_(options), for_each_(for_each), first_frame_(logs.size(), 0) {
    std::size_t scans = 0;
    for (auto const& mapped : logs) {
      merged_.push_back({.first_scan = scans,
                         .scans = mapped.log.scans.size(),
                         .key_frames = mapped.mapping.graph.size(),
                         .path_m = path_m(mapped.mapping.graph)});
      scans += mapped.log.scans.size();
    }
  }

  /// The first log's map stays where it is.
  void begin() {
    add_graph(0, Pose2{});
    add_seen(0);
  }

  /// What speaks against that log, which is then left out; nothing: it is in.
  std::string merge(std::size_t number) {
    constexpr auto apart = "it shares no place with the others that can be told from every other place";
    auto const keys = key_scans(logs_[number]);
    if (!known_) {
      auto known = KnownMap::make(draw_grid(seen_, graph_.poses, {}));
      if (!known) return apart;
      known_ = *std::move(known);
    }
    auto const common = find_common_place(*known_, keys, options_.loops.submap_frames, options_.frame);
    if (!common) return apart;
    auto const before = graph_;
    auto const first = graph_.size();
    auto const all_from_log = common->pose * inverse(keys.scans[static_cast<std::size_t>(common->scan)].odometry);
    auto const anchor = anchor_at(first + common->scan, common->pose);
    graph_.constraints.push_back(anchor);
    auto const records = records_.size();
    add_graph(number, all_from_log);
    auto const closures = close(first, anchor);
    if (!closures) {
      graph_ = before;
      records_.resize(records);
      return fmt::format("where it seems to meet the others, {}", closures.error());
    }
    merged_[number].closures = *closures;
    add_seen(number);
    return {};
  }

  Graph& graph() { return graph_; }
  [[nodiscard]] std::string const& name(std::size_t number) const { return logs_[number].name; }
  [[nodiscard]] MapperOptions const& options() const { return options_; }
  [[nodiscard]] std::vector<MergedLog> const& merged() const { return merged_; }
  [[nodiscard]] std::vector<LoopRecord> const& records() const { return records_; }

  /// The key frames of one of the logs, with its own numbers of scans.
  [[nodiscard]] Graph part(std::size_t number) const {
    Graph part;
    for (int k = 0; k < merged_[number].key_frames; ++k) {
      auto frame = graph_.frames[first_frame_[number] + k];
      frame.scan -= static_cast<int>(merged_[number].first_scan);
      part.frames.push_back(std::move(frame));
      part.poses.push_back(graph_.poses[first_frame_[number] + k]);
    }
    return part;
  }

 private:
  void add_graph(std::size_t number, Pose2 const& all_from_log) {
    auto const& from = logs_[number].mapping.graph;
    auto const first = graph_.size();
    first_frame_[number] = first;
    // So far apart on the way that no search takes one log's end and the next one's beginning for neighbours.
    auto const way_m = first == 0 ? 0.0 : path_m(graph_) + options_.loops.least_gap_m;
    for (int k = 0; k < from.size(); ++k) {
      auto frame = from.frames[k];
      frame.scan += static_cast<int>(merged_[number].first_scan);
      frame.path_m += way_m;
      graph_.frames.push_back(std::move(frame));
      graph_.poses.push_back(all_from_log * from.poses[k]);
    }
    for (auto constraint : from.constraints) {
      constraint.from += first;
      constraint.to += first;
      graph_.constraints.push_back(constraint);
    }
    for (auto record : logs_[number].mapping.loop_records) {
      record.query += first;
      record.target += first;
      records_.push_back(record);
    }
  }

  void add_seen(std::size_t number) {
    append(seen_, key_scans(logs_[number]));
    known_.reset();
  }

  /// What holds the new log where it was found until there are loops: to the key frame there that looks most alike.
  [[nodiscard]] Constraint anchor_at(int key, Pose2 const& pose) const {
    constexpr double m_per_rad = 1.0;
    int nearest = 0;
    auto least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < graph_.size(); ++k) {
      auto const apart = distance_m(graph_.poses[k], pose) + m_per_rad * turn_rad(graph_.poses[k], pose);
      if (apart < least) {
        least = apart;
        nearest = k;
      }
    }
    constexpr double shift = 1.0 / (0.1 * 0.1);
    constexpr double turn = 1.0 / (0.02 * 0.02);
    return {.from = nearest,
            .to = key,
            .from_to = between(graph_.poses[nearest], pose),
            .information = Eigen::Vector3d(shift, shift, turn).asDiagonal(),
            .is_loop = true};
  }

  /// Loops between the key frames from `first` on, which only the anchor holds, and those before; how many. Else what
  /// speaks against one building.
  [[nodiscard]] std::expected<int, std::string> close(int first, Constraint const& anchor) {
    auto const joins = [first](Constraint const& c) { return c.is_loop && c.from < first && c.to >= first; };
    LoopCloser closer(options_.loops, for_each_);
    closer.know(graph_);
    closer.finish(graph_, first);
    std::erase_if(graph_.constraints, [&](Constraint const& c) {
      return c.from == anchor.from && c.to == anchor.to && c.from_to == anchor.from_to;
    });
    auto const closures = static_cast<int>(std::ranges::count_if(graph_.constraints, joins));
    if (closures < least_closures)
      return std::unexpected(fmt::format("{} loops hold, and {} are needed", closures, least_closures));
    auto apart = graph_.poses;
    constexpr double beyond_sight_m = 1e4;
    for (auto k = static_cast<std::size_t>(first); k < apart.size(); ++k) apart[k].x += beyond_sight_m;
    auto const passes = agreement_of_passes(graph_, graph_.poses, apart, options_.loops.least_gap_m, for_each_);
    auto const most = options_.loops.most_contradiction_in_doubt;
    if (passes.conflict() > most)
      return std::unexpected(
          fmt::format("{:.0f} % of the points in sight lie in the other's free space ({:.0f} % at most)",
                      100.0 * passes.conflict(), 100.0 * most));
    if (auto const fits = share_that_fits(first); fits < least_that_fits)
      return std::unexpected(fmt::format("{:.0f} % of its key frames fit what was seen there ({:.0f} % at least)",
                                         100.0 * fits, 100.0 * least_that_fits));
    records_.insert(records_.end(), closer.records().begin(), closer.records().end());
    return closures;
  }

  /// Of the key frames from `first` on that were taken where others went, the share that fits what was seen then.
  [[nodiscard]] double share_that_fits(int first) const {
    std::vector<Pose2> const poses(graph_.poses.begin(), graph_.poses.begin() + first);
    std::vector<int> frames(static_cast<std::size_t>(graph_.size() - first));
    std::iota(frames.begin(), frames.end(), first);
    return fit_on_map(seen_, poses, graph_, frames).share();
  }

  std::vector<MappedLog>& logs_;
  MapperOptions options_;
  ForEach for_each_;
  Graph graph_;
  std::vector<int> first_frame_;  ///< of each log, in the graph
  std::vector<MergedLog> merged_;
  ScanLog seen_;  ///< the scans of the graph's key frames, in the same order
  std::optional<KnownMap> known_;
  std::vector<LoopRecord> records_;  ///< of all logs and of merging them, by the graph's numbers
};

/// Each log on what is merged by then, again and again, for the third may meet only the second.
base::Result<> merge_all(Merger& merger, std::size_t count, Progress const& progress) {
  std::vector<std::string> against(count, "not tried");
  against[0].clear();
  merger.begin();
  std::size_t done = 1;
  for (bool has_merged = true; has_merged && done < count;) {
    has_merged = false;
    for (std::size_t i = 1; i < count; ++i) {
      if (against[i].empty()) continue;
      progress("merging", static_cast<double>(done - 1) / static_cast<double>(count - 1));
      against[i] = merger.merge(i);
      if (!against[i].empty()) continue;
      ++done;
      has_merged = true;
    }
  }
  auto const left = std::ranges::find_if(against, [](std::string const& why) { return !why.empty(); });
  if (left == against.end()) return {};
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("{}: {}", merger.name(static_cast<std::size_t>(left - against.begin())), *left),
                    "logs are merged where several metres of one lead along the same walls as another");
}

}  // namespace

base::Result<MergedMaps> merge_maps(std::vector<MappedLog> logs, MapperOptions const& options, ForEach const& for_each,
                                    Progress const& progress) {
  LAPWING_ASSERT(!logs.empty());
  auto const kind = kind_of_all(logs, options.gather);
  if (kind.is_sparse && logs.size() > 1)
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("logs whose scans have fewer than {} readings are not merged", options.gather.few_readings));
  Merger merger(logs, options_for(kind, options), for_each);
  constexpr double merging = 0.7;
  constexpr double refining = 0.2;
  auto merged =
      merge_all(merger, logs.size(), [&](std::string_view stage, double share) { progress(stage, merging * share); });
  if (!merged) return std::unexpected(merged.error());
  progress("refining", merging);
  refine_jointly(merger.graph(), merger.options().joint, for_each);
  MergedMaps maps{.log = {}, .mapping = {}, .logs = merger.merged()};
  maps.mapping.loop_records = merger.records();
  maps.mapping.loops = counts_of(merger.records());
  for (std::size_t i = 0; i < logs.size(); ++i) {
    progress("filling in", merging + refining);
    auto& [name, log, mapping] = logs[i];
    // What one drive alone knew of the way between two key frames is as good as odometry gets.
    auto const part = merger.part(i);
    for (auto const& pose : fill(log, mapping.trajectory, way_of(part), part, options.frame, options.fill, for_each))
      maps.mapping.trajectory.push_back(pose);
    append(maps.log, std::move(log));
  }
  maps.mapping.graph = std::move(merger.graph());
  progress("done", 1.0);
  return maps;
}

}  // namespace lapwing::slam
