#include "slam/mapper.hpp"

namespace lapwing::slam {

Mapping map_log(ScanLog const& log, MapperOptions const& options, ForEach const& for_each, Progress const& progress) {
  Mapping mapping;
  auto& graph = mapping.graph;
  FrontEnd front_end(options.front_end);
  LoopCloser loops(options.loops, for_each);
  constexpr double driving = 0.7;  // of the time that a log takes
  double path_m = 0.0;
  for (int i = 0; i < static_cast<int>(log.scans.size()); ++i) {
    auto const& scan = log.scans[i];
    if (!front_end.wants(scan.odometry)) continue;
    auto frame = frame_of(scan, log.sensors[scan.sensor], options.frame);
    auto const step = front_end.add(graph.frames, graph.poses, frame, scan.odometry);
    if (step.constraint) path_m += distance_m(log.scans[graph.frames.back().scan].odometry, scan.odometry);
    graph.frames.push_back({.scan = i, .frame = std::move(frame), .path_m = path_m});
    graph.poses.push_back(step.pose);
    if (step.constraint) graph.constraints.push_back(*step.constraint);
    loops.follow(graph);
    progress("following", driving * i / static_cast<double>(log.scans.size()));
  }
  progress("closing loops", driving);
  loops.finish(graph);
  progress("refining", driving + 0.05);
  refine_jointly(graph, options.joint, for_each);
  progress("filling in", 0.85);
  mapping.trajectory = fill(log, graph, options.frame, options.fill, for_each);
  mapping.loops = loops.counts();
  mapping.loop_records = loops.records();
  progress("done", 1.0);
  return mapping;
}

}  // namespace lapwing::slam
