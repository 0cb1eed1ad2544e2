#include "robot/mapping/floor_map.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <Eigen/Dense>

#include "robot/mapping/stands_still.hpp"
#include "robot/mapping/who_walks.hpp"
#include "slam/graph/pose_graph.hpp"
#include "slam/prune/let_go.hpp"
#include "slam/robot_kind.hpp"

namespace lapwing::robot {

using slam::Pose2;

namespace {

/// Adds what the cells of `news` say to those of `grid`, and notes the tiles.
void merge(map::OccupancyGrid& grid, map::OccupancyGrid const& news, std::set<map::TileKey>& changed) {
  for (auto const& [key, tile] : news.tiles()) {
    auto& into = grid.tile_to_write(key);
    for (std::size_t i = 0; i < tile->cells.size(); ++i)
      if (tile->cells[i].is_seen()) into.cells[i] = into.cells[i].and_also(tile->cells[i]);
    changed.insert(key);
  }
}

/// What wheels may be off by over a part of a key frame's step: shift in m^2 a metre, turn in rad^2 a radian.
Eigen::Matrix3d spread_of(Pose2 const& driven) {
  constexpr double shift = 0.0025;
  constexpr double turn = 0.0025;
  auto const length_m = slam::place(driven).norm();
  auto const turned_rad = std::abs(driven.yaw);
  return Eigen::Vector3d(shift * length_m * length_m, shift * length_m * length_m,
                         turn * (turned_rad * turned_rad + 0.04 * length_m * length_m))
      .asDiagonal();
}

/// What is joined on the way is matched as logs of few readings are.
MappingOptions fitted(MappingOptions options, slam::Sensor const& sensor) {
  if (!slam::is_sparse(sensor, options.gather)) return options;
  // There an echo may have come from 0.4 m beside where it is laid.
  constexpr float cones_match_within_m = 3.0F;
  if (sensor.half_cone_rad > 0.0F)
    options.frame.most_range_m = std::min(options.frame.most_range_m, cones_match_within_m);
  slam::MapperOptions as_for_logs;
  as_for_logs.front_end = options.front_end;
  as_for_logs.loops = options.loops;
  as_for_logs.joint = options.joint;
  as_for_logs.gather = options.gather;
  as_for_logs = slam::options_for({.is_sparse = true}, std::move(as_for_logs));
  options.front_end = as_for_logs.front_end;
  options.loops = as_for_logs.loops;
  options.joint = as_for_logs.joint;
  options.leaves_out_who_walks = false;
  constexpr double align_every_share = 0.1;  // there are few key frames, and they drift more
  options.align_every_share = std::min(options.align_every_share, align_every_share);
  if (sensor.half_cone_rad == 0.0F) return options;
  // An echo lies anywhere on its arc: two of them weigh as much as one beam.
  options.front_end.point_information *= 0.5;
  // Nor do they hold a heading by what they are laid on, as beams do.
  options.front_end.heads_by_walls = true;
  // Most steps are turns on the spot, from which wheels and gyroscope know the next place better than echoes do.
  options.joint.steps = {
      .shift_m = 0.01, .shift_per_m = 0.02, .turn_rad = 0.004, .turn_per_m = 0.003, .turn_per_rad = 0.01};
  return options;
}

}  // namespace

FloorMap::FloorMap(slam::Sensor sensor, MappingOptions options)
    : options_(fitted(std::move(options), sensor)),
      is_sparse_(slam::is_sparse(sensor, options_.gather)),
      gatherer_(options_.gather, options_.frame),
      front_end_(options_.front_end),
      loops_(options_.loops, slam::one_by_one),
      grid_(options_.beam.cell_m, options_.site_from_map) {
  log_.sensors.push_back(std::move(sensor));
}

void FloorMap::add(slam::Scan scan) {
  odometry_ = scan.odometry;
  if (is_sparse_)
    add_sparse(std::move(scan));
  else if (front_end_.wants(scan.odometry))
    add_dense(std::move(scan));
  here_ = by_odometry(odometry_);
}

void FloorMap::add_dense(slam::Scan scan) {
  auto const& sensor = log_.sensors.front();
  bool const may_show_people = !graph_.frames.empty() && options_.leaves_out_who_walks;
  auto const stands_out =
      may_show_people ? without_who_walks(scan, sensor, by_odometry(scan.odometry).pose, graph_) : scan;
  bool const has_spun =
      !log_.scans.empty() && stands_still(log_.scans.back(), scan, sensor, slam::between(key_odometry_, scan.odometry));
  add_key_frame(slam::frame_of(stands_out, sensor, options_.frame), std::move(scan),
                has_spun ? slam::OdometryDoubt::has_spun : slam::OdometryDoubt::none);
  let_go_of_redundant();
  draw_key_frame();
}

void FloorMap::add_sparse(slam::Scan scan) {
  constexpr double step_m = 0.03;
  constexpr double step_rad = 0.02;
  constexpr slam::LogTime still_s(0.5);  // a door may open before a robot that stands
  gatherer_.add(scan, log_.sensors.front(), scan.odometry);
  bool const is_first = graph_.frames.empty();
  if (is_first || gatherer_.is_due()) {
    add_key_frame(gatherer_.take(), std::move(scan));
    return draw_key_frame();
  }
  auto const& last = log_.scans.back();
  bool const is_new = slam::distance_m(last.odometry, scan.odometry) > step_m ||
                      slam::turn_rad(last.odometry, scan.odometry) > step_rad || scan.time - last.time > still_s;
  if (!is_new) return;
  hold(std::move(scan));
  draw_last();
}

void FloorMap::add_key_frame(slam::Frame frame, slam::Scan scan, slam::OdometryDoubt doubt) {
  // The map begins where the robot does, whatever its wheels had counted before.
  bool const is_first = graph_.frames.empty();
  auto const driven = is_first ? Pose2() : slam::between(key_odometry_, scan.odometry);
  auto step = front_end_.add(graph_.frames, graph_.poses, frame, scan.odometry, doubt);
  if (is_first) step.pose = {};
  if (step.constraint) path_m_ += slam::place(driven).norm();
  graph_.frames.push_back({.scan = key_frames_++, .frame = std::move(frame), .path_m = path_m_});
  graph_.poses.push_back(step.pose);
  if (step.constraint) {
    graph_.constraints.push_back(*step.constraint);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    turn.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(graph_.poses[graph_.poses.size() - 2].yaw).toRotationMatrix();
    key_covariance_ = turn * step.constraint->information.inverse() * turn.transpose();
  }
  key_times_.push_back(scan.time);
  key_odometry_ = scan.odometry;
  // What was seen on the way to it was laid together with it.
  for (auto i = since_key_; i < holds_.size(); ++i)
    holds_[i] = {graph_.size() - 1, slam::between(key_odometry_, log_.scans[i].odometry)};
  hold(std::move(scan));
  since_key_ = holds_.size();
  loops_.follow(graph_);
}

void FloorMap::hold(slam::Scan scan) {
  bool const is_far = on_the_way_.empty() || slam::distance_m(log_.scans[on_the_way_.back()].odometry, scan.odometry) >
                                                 options_.front_end.key_step_m;
  if (is_sparse_ && is_far) on_the_way_.push_back(log_.scans.size());
  holds_.push_back({graph_.size() - 1, slam::between(key_odometry_, scan.odometry)});
  log_.scans.push_back(std::move(scan));
}

std::vector<Pose2> FloorMap::way() const {
  if (!is_sparse_) return graph_.poses;
  std::vector<Pose2> poses;
  poses.reserve(on_the_way_.size());
  for (auto const scan : on_the_way_) poses.push_back(pose_of(scan));
  return poses;
}

Pose2 FloorMap::pose_of(std::size_t scan) const {
  return graph_.poses[holds_[scan].frame] * holds_[scan].in_frame;
}

Located FloorMap::by_odometry(Pose2 const& odometry) const {
  auto const driven = slam::between(key_odometry_, odometry);
  return {graph_.poses.back() * driven, key_covariance_ + spread_of(driven)};
}

/// What is aligned beside this map has the key frames' numbers as they were when that began.
void FloorMap::let_go_of_redundant() {
  if (--until_let_go_ > 0 || is_aligning_) return;
  until_let_go_ = options_.prune.every_frames;
  auto const redundant = slam::redundant_frames(graph_, options_.prune);
  if (redundant.empty()) return;
  auto const renumbering = slam::let_go(graph_, redundant, options_.prune.most_loops);
  slam::keep_staying(log_.scans, renumbering);
  slam::keep_staying(key_times_, renumbering);
  slam::keep_staying(holds_, renumbering);
  for (int frame = 0; frame < graph_.size(); ++frame) holds_[static_cast<std::size_t>(frame)].frame = frame;
  since_key_ = holds_.size();
  slam::keep_staying(drawn_at_, renumbering);
  loops_.renumber(graph_, renumbering);
}

bool FloorMap::wants_alignment(bool soon) const {
  auto const driven_m = path_m_ - aligned_at_m_;
  return soon ? driven_m > 0.0 : driven_m > std::max(options_.align_every_m, options_.align_every_share * path_m_);
}

std::unique_ptr<slam::JointAlignment> FloorMap::begin_alignment() {
  aligned_at_m_ = path_m_;
  is_aligning_ = true;
  return std::make_unique<slam::JointAlignment>(graph_, options_.joint, front_end_.headings(graph_));
}

void FloorMap::take(std::vector<Pose2> const& aligned) {
  is_aligning_ = false;
  auto const count = static_cast<int>(aligned.size());
  if (count < 2) return;
  auto const before = graph_.poses;
  for (int k = 0; k < graph_.size(); ++k)
    graph_.poses[k] = k < count ? aligned[k] : aligned.back() * slam::between(before[count - 1], before[k]);
  // What is aligned was measured anew. By the old edges the next loop would put everything back to where it was.
  bool has_new_loops = false;
  for (auto& constraint : graph_.constraints) {
    auto const& [from, to] = std::pair(constraint.from, constraint.to);
    if (std::max(from, to) < count) {
      constraint.from_to = slam::between(aligned[from], aligned[to]);
    } else {
      has_new_loops = has_new_loops || constraint.is_loop;
    }
  }
  if (has_new_loops)
    graph_.poses = slam::optimize(graph_.poses, graph_.constraints,
                                  {.most_rounds = 10, .loop_tolerance = options_.loops.tolerance, .small_step = 1e-3})
                       .poses;
  here_.pose = graph_.poses.back() * slam::between(before.back(), here_.pose);
  redraw();
}

bool FloorMap::wants_redraw() const {
  double shift_m = 0.0;
  double turn_rad = 0.0;
  for (std::size_t i = 0; i < drawn_at_.size(); ++i) {
    shift_m = std::max(shift_m, slam::distance_m(drawn_at_[i], graph_.poses[i]));
    turn_rad = std::max(turn_rad, slam::turn_rad(drawn_at_[i], graph_.poses[i]));
  }
  if (shift_m > options_.far_m || turn_rad > options_.far_rad) return true;
  bool const has_moved = shift_m > options_.redraw_m || turn_rad > options_.redraw_rad;
  return has_moved && path_m_ - redrawn_at_m_ > options_.redraw_every_m;
}

void FloorMap::draw_key_frame() {
  if (wants_redraw()) {
    redraw();
  } else {
    draw_last();
  }
}

void FloorMap::draw_last() {
  slam::ScanLog const last{.sensors = log_.sensors, .scans = {log_.scans.back()}};
  merge(grid_, slam::draw_grid(last, {pose_of(log_.scans.size() - 1)}, options_.beam), changed_);
  drawn_at_.insert(drawn_at_.end(), graph_.poses.begin() + std::ssize(drawn_at_), graph_.poses.end());
}

void FloorMap::redraw() {
  map::OccupancyGrid grid(options_.beam.cell_m, options_.site_from_map);
  std::set<map::TileKey> drawn;
  std::vector<Pose2> poses;
  poses.reserve(log_.scans.size());
  for (std::size_t scan = 0; scan < log_.scans.size(); ++scan) poses.push_back(pose_of(scan));
  merge(grid, slam::draw_grid(log_, poses, options_.beam), drawn);
  for (auto const& [key, tile] : grid_.tiles())
    if (!drawn.contains(key)) drawn.insert(key);
  for (auto const key : drawn) {
    auto const before = grid_.tiles().find(key);
    auto const after = grid.tiles().find(key);
    bool const is_same =
        before != grid_.tiles().end() && after != grid.tiles().end() && before->second->cells == after->second->cells;
    if (!is_same) changed_.insert(key);
  }
  grid_ = std::move(grid);
  shifts_.emplace_back(drawn_at_, std::span(graph_.poses).first(drawn_at_.size()));
  drawn_at_ = graph_.poses;
  redrawn_at_m_ = path_m_;
  ++redrawn_;
}

std::vector<map::TileKey> FloorMap::take_changes() {
  std::vector<map::TileKey> changes(changed_.begin(), changed_.end());
  changed_.clear();
  return changes;
}

}  // namespace lapwing::robot
