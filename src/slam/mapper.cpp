#include "slam/mapper.hpp"

#include <algorithm>

namespace lapwing::slam {

Mapper::Mapper(MapperOptions const& options, RobotKind const& kind, ForEach for_each)
    : options_(options),
      kind_(kind),
      for_each_(std::move(for_each)),
      front_end_(options.front_end),
      loops_(options.loops, for_each_) {}

Pose2 Mapper::follow(Scan const& scan, Sensor const& sensor) {
  std::optional<Frame> frame;
  auto const number = scans_++;
  odometry_ = scan.odometry;
  if (!kind_.has_odometry) {
    frame = frame_of(scan, sensor, options_.frame);
    odometry_ = scan_odometry_.follow(*frame, scan.time);
  }
  if (!front_end_.wants(odometry_)) return pose();
  if (!frame) frame = frame_of(scan, sensor, options_.frame);
  auto const step = front_end_.add(graph_.frames, graph_.poses, *frame, odometry_);
  auto const path_m =
      graph_.frames.empty() ? 0.0 : graph_.frames.back().path_m + distance_m(graph_.poses.back(), step.pose);
  graph_.frames.push_back({.scan = number, .frame = *std::move(frame), .path_m = path_m});
  graph_.poses.push_back(step.pose);
  if (step.constraint) graph_.constraints.push_back(*step.constraint);
  key_odometry_ = odometry_;
  is_new_ = true;

  auto known = std::ranges::find(seen_.sensors, sensor);
  if (known == seen_.sensors.end()) known = seen_.sensors.insert(known, sensor);
  seen_.scans.push_back(scan);
  seen_.scans.back().sensor = static_cast<int>(known - seen_.sensors.begin());
  return step.pose;
}

bool Mapper::close_loops() {
  if (!is_new_) return false;
  is_new_ = false;
  return loops_.follow(graph_);
}

Pose2 Mapper::pose() const {
  return graph_.poses.empty() ? odometry_ : graph_.poses.back() * between(key_odometry_, odometry_);
}

map::OccupancyGrid Mapper::grid(BeamModel const& model) const {
  return draw_grid(seen_, graph_.poses, model);
}

void Mapper::finish(Progress const& progress) {
  progress("closing loops", 0.0);
  loops_.finish(graph_);
  progress("refining", 0.4);
  refine_jointly(graph_, options_.joint, for_each_);
}

Mapping map_log(ScanLog const& log, MapperOptions const& options, ForEach const& for_each, Progress const& progress) {
  Mapper mapper(options, {.has_odometry = log.has_odometry}, for_each);
  constexpr double driving = 0.7;  // of the time that a log takes
  constexpr double finishing = 0.15;
  std::vector<Pose2> odometry;
  odometry.reserve(log.scans.size());
  for (auto const& scan : log.scans) {
    progress("following", driving * static_cast<double>(odometry.size()) / static_cast<double>(log.scans.size()));
    mapper.follow(scan, log.sensors[scan.sensor]);
    mapper.close_loops();
    odometry.push_back(mapper.odometry());
  }
  mapper.finish([&](std::string_view stage, double share) { progress(stage, driving + finishing * share); });
  progress("filling in", driving + finishing);
  Mapping mapping;
  mapping.loops = mapper.loops().counts();
  mapping.loop_records = mapper.loops().records();
  mapping.graph = std::move(mapper).take_graph();
  mapping.trajectory = fill(log, odometry, mapping.graph, options.frame, options.fill, for_each);
  progress("done", 1.0);
  return mapping;
}

}  // namespace lapwing::slam
