#include "explore/path/navigator.hpp"

#include <algorithm>
#include <cmath>

#include "explore/floor/ray.hpp"
#include "geo/position.hpp"

namespace lapwing::explore {

namespace {

constexpr double drawn_m = 6.0;  ///< of the way that is drawn exactly
constexpr double look_ahead_m = 0.8;
constexpr double off_path_m = 0.6;  ///< then a new one is made
constexpr double arrived_m = 0.15;
constexpr double turn_first_rad = 0.6;  ///< farther to the side than this, the robot turns where it stands
constexpr double turn_gain = 2.5;

/// All cells on the straight line between the two can be stood on.
bool is_way_clear(KnownMap const& map, Place const& from, Place const& to) {
  auto const way = to - from;
  double const length_m = way.length();
  if (length_m < 1e-9) return true;
  bool is_clear = true;
  walk_line(from.x() / map.cell_m(), from.y() / map.cell_m(), way.x() / length_m, way.y() / length_m,
            length_m / map.cell_m(), [&](Cell cell, double) { return is_clear = map.is_standable(cell); });
  return is_clear;
}

}  // namespace

void Navigator::go_to(Cell goal) {
  if (goal_ == goal && (state_ == State::driving || state_ == State::arrived)) return;
  goal_ = goal;
  state_ = State::driving;
  path_.clear();
}

void Navigator::stop() {
  goal_.reset();
  state_ = State::idle;
  path_.clear();
}

bool Navigator::is_path_good(KnownMap const& map, Pose const& pose, std::vector<Disc> const& closed) const {
  if (path_.empty()) return false;
  bool const is_to_the_end = path_.back() == *goal_;
  auto const left = static_cast<double>(path_.size() - at_) * map.cell_m();
  if (!is_to_the_end && left < drawn_m / 3.0) return false;
  if (distance_m(map.middle(path_[at_]), pose.position) > off_path_m) return false;
  auto const end = std::min(path_.size(), at_ + static_cast<std::size_t>(3.0 / map.cell_m()));
  for (std::size_t i = at_ + 1; i < end; ++i) {
    if (!map.is_standable(path_[i])) return false;
    auto const place = map.middle(path_[i]);
    if (std::ranges::any_of(closed, [&](Disc const& disc) { return distance_m(disc.middle, place) < disc.radius_m; }))
      return false;
  }
  return true;
}

std::vector<Cell> Navigator::next_path(Roads roads, Cell from, std::vector<Disc> const& closed,
                                       std::vector<Disc> const& closed_far) const {
  auto const draw = [&](Cell to) {
    return roads.search.path(roads.map, {.from = from, .to = to, .radius_m = limits_.radius_m, .closed = &closed});
  };
  if (length_of(*goal_ - from) * roads.map.cell_m() < drawn_m) {
    auto path = draw(*goal_);
    if (!path.empty()) return path;
  }
  auto const root = roads.graph.node_near(from);
  auto const end = roads.graph.node_near(*goal_);
  if (!root || !end) return {};
  auto const way = roads.graph.way(*root, *end, closed_far);
  if (way.empty()) return {};
  double so_far_m = 0.0;
  std::size_t next = 0;
  while (next + 1 < way.size() && so_far_m < drawn_m) {
    so_far_m += length_of(roads.graph.place_of(way[next + 1]) - roads.graph.place_of(way[next])) * roads.map.cell_m();
    ++next;
  }
  return draw(next + 1 == way.size() ? *goal_ : roads.graph.place_of(way[next]));
}

void Navigator::plan(Roads roads, Pose const& pose, std::vector<Disc> const& closed,
                     std::vector<Disc> const& closed_far) {
  if (!goal_ || state_ == State::arrived) return;
  if (distance_m(roads.map.middle(*goal_), pose.position) < arrived_m) {
    state_ = State::arrived;
    path_.clear();
    return;
  }
  if (is_path_good(roads.map, pose, closed)) return;
  path_ = next_path(roads, roads.map.cell_at(pose.position), closed, closed_far);
  at_ = 0;
  state_ = path_.empty() ? State::blocked : State::driving;
}

Motion Navigator::steer(KnownMap const& map, Pose const& pose, double speed_m_s) {
  if (path_.empty() || !goal_) return {};
  // What lies nearest is where it is; a path may come by the same place twice, so only a little is looked ahead.
  auto const near_end = std::min(path_.size(), at_ + static_cast<std::size_t>(1.0 / map.cell_m()) + 2);
  for (std::size_t i = at_; i < near_end; ++i) {
    if (distance_m(map.middle(path_[i]), pose.position) <= distance_m(map.middle(path_[at_]), pose.position)) at_ = i;
  }
  std::size_t aim = std::min(at_ + 1, path_.size() - 1);
  for (std::size_t i = aim + 1; i < path_.size(); ++i) {
    if (distance_m(map.middle(path_[i]), pose.position) > look_ahead_m) break;
    if (!is_way_clear(map, pose.position, map.middle(path_[i]))) break;
    aim = i;
  }
  auto const target = map.middle(path_[aim]);
  auto const way = target - pose.position;
  if (aim + 1 == path_.size() && way.length() < arrived_m) {
    if (path_.back() == *goal_) state_ = State::arrived;
    path_.clear();
    return {};
  }
  double const off = geo::wrap_pi(std::atan2(way.y(), way.x()) - pose.yaw_rad);
  double const end_m = static_cast<double>(path_.size() - 1 - at_) * map.cell_m();
  bool const is_last = path_.back() == *goal_;
  double const braked = is_last ? std::sqrt(2.0 * limits_.acceleration_m_s2 * std::max(end_m - 0.05, 0.02)) : speed_m_s;
  double const ahead = std::abs(off) > turn_first_rad ? 0.0 : std::cos(off) * std::min(speed_m_s, braked);
  return {ahead, turn_gain * off};
}

}  // namespace lapwing::explore
