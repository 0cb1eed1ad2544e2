#include "slam/mapper.hpp"

#include <algorithm>
#include <cmath>

#include "slam/match/odometry_bias.hpp"

namespace lapwing::slam {
namespace {

/// Whether no robot moves so within that time.
bool is_leap(Pose2 const& motion, LogTime elapsed) {
  constexpr double most_m_s = 3.0;
  constexpr double most_rad_s = 4.0;
  constexpr double least_s = 0.2;  // stamps of recordings come in bunches
  auto const seconds = std::max(least_s, elapsed.count());
  return std::hypot(motion.x, motion.y) > most_m_s * seconds || std::abs(motion.yaw) > most_rad_s * seconds;
}

}  // namespace

Mapper::Mapper(MapperOptions const& options, RobotKind const& kind, ForEach for_each)
    : options_(options_for(kind, options)),
      kind_(kind),
      for_each_(std::move(for_each)),
      front_end_(options_.front_end),
      loops_(options_.loops, for_each_),
      gatherer_(options_.gather, options_.frame) {}

Pose2 Mapper::follow(Scan const& scan, Sensor const& sensor) {
  std::optional<Frame> frame;
  ++scans_;
  auto const last_odometry = odometry_;
  odometry_ = scan.odometry;
  if (!kind_.has_odometry) {
    frame = frame_of(scan, sensor, options_.frame);
    odometry_ = scan_odometry_.follow(*frame, scan.time);
  }
  constexpr LogTime unknown(1.0);
  auto const elapsed = kind_.has_times ? scan.time - time_ : unknown;
  has_leapt_ = has_leapt_ || (scans_ > 1 && is_leap(between(last_odometry, odometry_), elapsed));
  time_ = scan.time;
  if (kind_.is_sparse) {
    gatherer_.add(scan, sensor, odometry_);
    if (gatherer_.is_due()) add_key_frame(gatherer_.take(), scan, sensor);
  } else if (front_end_.wants(odometry_)) {
    if (!frame) frame = frame_of(scan, sensor, options_.frame);
    add_key_frame(*std::move(frame), scan, sensor);
  }
  return pose();
}

void Mapper::add_key_frame(Frame frame, Scan const& scan, Sensor const& sensor) {
  auto const step = front_end_.add(graph_.frames, graph_.poses, frame, odometry_, has_leapt_);
  has_leapt_ = false;
  auto const path_m =
      graph_.frames.empty() ? 0.0 : graph_.frames.back().path_m + distance_m(graph_.poses.back(), step.pose);
  graph_.frames.push_back({.scan = scans_ - 1, .frame = std::move(frame), .path_m = path_m});
  graph_.poses.push_back(step.pose);
  if (step.constraint) graph_.constraints.push_back(*step.constraint);
  key_odometry_ = odometry_;
  is_new_ = true;

  auto known = std::ranges::find(seen_.sensors, sensor);
  if (known == seen_.sensors.end()) known = seen_.sensors.insert(known, sensor);
  seen_.scans.push_back(scan);
  seen_.scans.back().sensor = static_cast<int>(known - seen_.sensors.begin());
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
  auto const kind = kind_of(log, options.gather);
  Mapper mapper(options, kind, for_each);
  constexpr double driving = 0.7;  // of the time that a log takes
  constexpr double finishing = 0.15;
  std::vector<Pose2> odometry;
  odometry.reserve(log.scans.size());
  std::vector<Pose2> told;
  for (auto const& scan : log.scans) told.push_back(scan.odometry);
  if (kind.is_sparse && kind.has_odometry) told = without_bias(told, find_bias(log, told));
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
  mapping.loops = mapper.loops().counts();
  mapping.loop_records = mapper.loops().records();
  mapping.graph = std::move(mapper).take_graph();
  mapping.trajectory = kind.is_sparse ? spread_over_scans(odometry, mapping.graph)
                                      : fill(log, odometry, mapping.graph, options.frame, options.fill, for_each);
  progress("done", 1.0);
  return mapping;
}

}  // namespace lapwing::slam
