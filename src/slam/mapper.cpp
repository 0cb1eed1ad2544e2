#include "slam/mapper.hpp"

#include <algorithm>
#include <limits>

#include "base/assert.hpp"

namespace lapwing::slam {

Mapper::Mapper(MapperOptions const& options, RobotKind const& kind, ForEach for_each)
    : options_(options_for(kind, options)),
      kind_(kind),
      for_each_(std::move(for_each)),
      front_end_(options_.front_end),
      loops_(options_.loops, for_each_),
      gatherer_(options_.gather, options_.frame) {
  memory_.options = options;
  memory_.kind = kind;
}

Mapper::Mapper(SavedMap saved, ForEach for_each)
    : Mapper(saved.memory.options, saved.memory.kind, std::move(for_each)) {
  memory_ = std::move(saved.memory);
  graph_ = std::move(saved.graph);
  seen_ = std::move(memory_.seen);
  scans_ = static_cast<int>(memory_.past.size());
  odometry_ = memory_.odometry;
  key_odometry_ = memory_.key_odometry;
  time_ = memory_.time;
  front_end_.remember(memory_.front_end);
  loops_.know(graph_);
}

void Mapper::begin_drive(RobotKind const& kind, std::optional<Pose2> const& start) {
  LAPWING_ASSERT(!graph_.frames.empty());
  kind_.has_odometry = kind.has_odometry;
  kind_.has_times = kind.has_times;
  watch_.begin_drive();
  scan_odometry_ = {};
  began_at_m_ = graph_.frames.back().path_m;
  if (!start) return;
  begins_drive_ = true;
  front_end_.begin_at(*start);
}

Pose2 Mapper::follow(Scan const& scan, Sensor const& sensor) {
  std::optional<Frame> frame;
  ++scans_;
  odometry_ = scan.odometry;
  if (!kind_.has_odometry) {
    frame = frame_of(scan, sensor, options_.frame);
    odometry_ = scan_odometry_.follow(*frame, scan.time);
  }
  constexpr LogTime unknown(1.0);
  watch_.follow(odometry_, kind_.has_times ? scan.time - time_ : unknown);
  time_ = scan.time;
  auto const doubt = watch_.has_leapt() ? OdometryDoubt::has_leapt : OdometryDoubt::none;
  if (kind_.is_sparse) {
    gatherer_.add(scan, sensor, odometry_);
    if (gatherer_.is_due()) add_key_frame(gatherer_.take(), scan, sensor, doubt);
  } else if (front_end_.wants(odometry_)) {
    if (!frame) frame = frame_of(scan, sensor, options_.frame);
    add_key_frame(*std::move(frame), scan, sensor, doubt);
  } else if (options_.front_end.may_freeze && watch_.is_suspiciously_still()) {
    if (!frame) frame = frame_of(scan, sensor, options_.frame);
    auto const [motion, is_sure] = front_end_.seen_motion(graph_.frames, graph_.poses, *frame);
    if (front_end_.is_a_step(motion))
      add_key_frame(*std::move(frame), scan, sensor, OdometryDoubt::has_frozen);
    else if (is_rest(motion))
      watch_.found_still(is_sure);
  }
  return pose();
}

void Mapper::add_key_frame(Frame frame, Scan const& scan, Sensor const& sensor, OdometryDoubt doubt) {
  auto const step = front_end_.add(graph_.frames, graph_.poses, frame, odometry_, doubt);
  watch_.begin_key_frame();
  graph_.frames.push_back(
      {.scan = scans_ - 1, .frame = std::move(frame), .path_m = path_to(step.pose), .is_cut = begins_drive_});
  graph_.poses.push_back(step.pose);
  if (step.constraint) graph_.constraints.push_back(*step.constraint);
  if (begins_drive_) {
    hold_to_map();
    began_at_m_ = graph_.frames.back().path_m;
  }
  begins_drive_ = false;
  key_odometry_ = odometry_;
  is_new_ = true;

  auto known = std::ranges::find(seen_.sensors, sensor);
  if (known == seen_.sensors.end()) known = seen_.sensors.insert(known, sensor);
  seen_.scans.push_back(scan);
  seen_.scans.back().sensor = static_cast<int>(known - seen_.sensors.begin());
}

double Mapper::path_to(Pose2 const& pose) const {
  if (graph_.frames.empty()) return 0.0;
  // So far apart on the way that no search takes one drive's end and the next one's beginning for neighbours.
  auto const step_m = begins_drive_ ? options_.loops.least_gap_m : distance_m(graph_.poses.back(), pose);
  return graph_.frames.back().path_m + step_m;
}

/// What holds the first key frame of a drive that began somewhere on the map: to the key frame there that looks most
/// alike, loosely, so that loops decide.
void Mapper::hold_to_map() {
  constexpr double m_per_rad = 1.0;
  constexpr double shift = 1.0 / (0.3 * 0.3);
  constexpr double turn = 1.0 / (0.05 * 0.05);
  auto const last = graph_.size() - 1;
  auto const& pose = graph_.poses[last];
  int nearest = 0;
  auto least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < last; ++k) {
    auto const apart = distance_m(graph_.poses[k], pose) + m_per_rad * turn_rad(graph_.poses[k], pose);
    if (apart >= least) continue;
    least = apart;
    nearest = k;
  }
  graph_.constraints.push_back({.from = nearest,
                                .to = last,
                                .from_to = between(graph_.poses[nearest], pose),
                                .information = Eigen::Vector3d(shift, shift, turn).asDiagonal()});
}

bool Mapper::close_loops() {
  if (!is_new_) return false;
  is_new_ = false;
  auto const has_closed = loops_.follow(graph_);
  // What was gathered is no scan that later ones could take the place of.
  if (!kind_.is_sparse && --until_let_go_ <= 0) let_go_of_redundant();
  return has_closed;
}

void Mapper::let_go_of_redundant() {
  until_let_go_ = options_.prune.every_frames;
  auto const redundant = redundant_frames(graph_, options_.prune);
  if (redundant.empty()) return;
  auto const first_scan = static_cast<int>(memory_.past.size());
  for (auto const& [frame, heir] : redundant)
    if (graph_.frames[frame].scan >= first_scan) gone_.push_back({graph_.frames[frame].scan, frame, Pose2{}});
  auto const renumbering = let_go(graph_, redundant, options_.prune.most_loops);
  keep_staying(seen_.scans, renumbering);
  loops_.renumber(graph_, renumbering);
  auto const hand_on = [&](int& heir, Pose2& in_heir) {
    auto const& inheritance = renumbering.inheritances[heir];
    in_heir = inheritance.in_heir * in_heir;
    heir = inheritance.heir;
  };
  for (auto& gone : gone_) hand_on(gone.heir, gone.in_heir);
  for (auto& scan : memory_.past) hand_on(scan.frame, scan.in_frame);
}

std::vector<WayPoint> Mapper::gone() const {
  std::vector<WayPoint> way;
  for (auto const& [scan, heir, in_heir] : gone_)
    way.push_back({.scan = scan, .frame = heir, .pose = graph_.poses[heir] * in_heir, .is_key = false});
  std::ranges::sort(way, {}, &WayPoint::scan);
  return way;
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

SavedMap Mapper::take() && {
  memory_.seen = std::move(seen_);
  memory_.loops += loops_.counts();
  memory_.front_end = front_end_.memory();
  memory_.odometry = odometry_;
  memory_.key_odometry = key_odometry_;
  memory_.time = time_;
  return {.graph = std::move(graph_), .memory = std::move(memory_)};
}

}  // namespace lapwing::slam
