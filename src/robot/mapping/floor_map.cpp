#include "robot/mapping/floor_map.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <Eigen/Dense>

#include "robot/mapping/who_walks.hpp"
#include "slam/graph/pose_graph.hpp"
#include "slam/prune/let_go.hpp"

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

}  // namespace

FloorMap::FloorMap(slam::Sensor sensor, MappingOptions options)
    : options_(std::move(options)),
      front_end_(options_.front_end),
      loops_(options_.loops, slam::one_by_one),
      grid_(options_.beam.cell_m, options_.site_from_map) {
  log_.sensors.push_back(std::move(sensor));
}

void FloorMap::add(slam::Scan scan) {
  odometry_ = scan.odometry;
  if (front_end_.wants(scan.odometry)) return add_key_frame(std::move(scan));
  auto const driven = slam::between(log_.scans.back().odometry, scan.odometry);
  here_ = {graph_.poses.back() * driven, key_covariance_ + spread_of(driven)};
}

void FloorMap::add_key_frame(slam::Scan scan) {
  auto const& sensor = log_.sensors.front();
  // The map begins where the robot does, whatever its wheels had counted before.
  bool const is_first = graph_.frames.empty();
  auto const driven = is_first ? Pose2() : slam::between(log_.scans.back().odometry, scan.odometry);
  bool const may_show_people = !is_first && options_.leaves_out_who_walks;
  auto frame =
      slam::frame_of(may_show_people ? without_who_walks(scan, sensor, graph_.poses.back() * driven, graph_) : scan,
                     sensor, options_.frame);
  auto step = front_end_.add(graph_.frames, graph_.poses, frame, scan.odometry);
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
  log_.scans.push_back(std::move(scan));
  loops_.follow(graph_);
  let_go_of_redundant();
  if (wants_redraw()) {
    redraw();
  } else {
    draw_last();
  }
  here_ = {graph_.poses.back(), key_covariance_};
}

/// What is aligned beside this map has the key frames' numbers as they were when that began.
void FloorMap::let_go_of_redundant() {
  if (--until_let_go_ > 0 || is_aligning_) return;
  until_let_go_ = options_.prune.every_frames;
  auto const redundant = slam::redundant_frames(graph_, options_.prune);
  if (redundant.empty()) return;
  auto const renumbering = slam::let_go(graph_, redundant, options_.prune.most_loops);
  slam::keep_staying(log_.scans, renumbering);
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
  return std::make_unique<slam::JointAlignment>(graph_, options_.joint);
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

void FloorMap::draw_last() {
  slam::ScanLog const last{.sensors = log_.sensors, .scans = {log_.scans.back()}};
  merge(grid_, slam::draw_grid(last, {graph_.poses.back()}, options_.beam), changed_);
  drawn_at_.push_back(graph_.poses.back());
}

void FloorMap::redraw() {
  map::OccupancyGrid grid(options_.beam.cell_m, options_.site_from_map);
  std::set<map::TileKey> drawn;
  merge(grid, slam::draw_grid(log_, graph_.poses, options_.beam), drawn);
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
