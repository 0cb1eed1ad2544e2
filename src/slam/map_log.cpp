#include <algorithm>
#include <utility>

#include "slam/mapper.hpp"
#include "slam/match/odometry_bias.hpp"

namespace lapwing::slam {
namespace {

std::vector<Pose2> told_odometry(ScanLog const& log, RobotKind const& kind) {
  std::vector<Pose2> told;
  told.reserve(log.scans.size());
  for (auto const& scan : log.scans) told.push_back(scan.odometry);
  if (kind.is_sparse && kind.has_odometry) told = without_bias(told, find_bias(log, told));
  return told;
}

/// The key frames of the last drive and what became of those that were let go, its first scan counted as 0.
std::vector<WayPoint> way_since(Graph const& graph, std::vector<WayPoint> const& gone, int first_scan) {
  auto way = way_of(graph);
  std::erase_if(way, [&](WayPoint const& point) { return point.scan < first_scan; });
  way.insert(way.end(), gone.begin(), gone.end());
  std::ranges::sort(way, {}, &WayPoint::scan);
  for (auto& point : way) point.scan -= first_scan;
  return way;
}

/// Where the scans of earlier drives are by now.
std::vector<Pose2> carried_along(std::vector<PastScan> const& past, Graph const& graph) {
  std::vector<Pose2> poses;
  poses.reserve(past.size());
  for (auto const& scan : past) poses.push_back(graph.poses[scan.frame] * scan.in_frame);
  return poses;
}

int key_frames_since(Graph const& graph, int first_scan) {
  auto const first = std::ranges::lower_bound(graph.frames, first_scan, {}, &KeyFrame::scan);
  return static_cast<int>(graph.frames.end() - first);
}

}  // namespace

Mapping map_log(ScanLog const& log, MapperOptions const& options, ForEach const& for_each, Progress const& progress) {
  return map_drive(Mapper(options, kind_of(log, options.gather), for_each), log, for_each, progress);
}

Mapping map_drive(Mapper mapper, ScanLog const& log, ForEach const& for_each, Progress const& progress) {
  constexpr double driving = 0.7;  // of the time that a log takes
  constexpr double finishing = 0.15;
  auto const kind = mapper.kind();
  auto const options = mapper.options();
  auto const told = told_odometry(log, kind);
  std::vector<Pose2> odometry;
  odometry.reserve(log.scans.size());
  for (auto scan : log.scans) {
    progress("following", driving * static_cast<double>(odometry.size()) / static_cast<double>(log.scans.size()));
    scan.odometry = told[odometry.size()];
    mapper.follow(scan, log.sensors[scan.sensor]);
    mapper.close_loops();
    odometry.push_back(mapper.odometry());
  }
  mapper.finish([&](std::string_view stage, double share) { progress(stage, driving + finishing * share); });
  progress("filling in", driving + finishing);
  Mapping mapping;
  mapping.loop_records = mapper.loops().records();
  auto const gone = mapper.gone();
  auto const driven_m = mapper.driven_m();
  auto saved = std::move(mapper).take();
  mapping.graph = std::move(saved.graph);
  mapping.memory = std::move(saved.memory);
  mapping.loops = mapping.memory.loops;
  auto& past = mapping.memory.past;
  auto const first_scan = static_cast<int>(past.size());
  auto const way = way_since(mapping.graph, gone, first_scan);
  auto const trajectory = kind.is_sparse
                              ? spread_over_scans(odometry, mapping.graph)
                              : fill(log, odometry, way, mapping.graph, options.frame, options.fill, for_each);
  mapping.trajectory = carried_along(past, mapping.graph);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    mapping.trajectory.push_back(trajectory[i]);
    if (way.empty()) continue;
    auto const frame = way_point_before(way, static_cast<int>(i)).frame;
    past.push_back({log.scans[i].time, frame, between(mapping.graph.poses[frame], trajectory[i])});
  }
  mapping.memory.drives.push_back({.name = {},
                                   .scans = static_cast<int>(log.scans.size()),
                                   .key_frames = key_frames_since(mapping.graph, first_scan),
                                   .path_m = driven_m});
  progress("done", 1.0);
  return mapping;
}

}  // namespace lapwing::slam
