#include "robot/planner/room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slam/scan/gather.hpp"

namespace lapwing::robot {

namespace {

constexpr double looks_back_rad = 2.8;  ///< a beam that far from ahead

constexpr slam::LogTime remembered(2.0);  ///< who walks is elsewhere by then

/// Two echoes of one sonar so far apart are of one wall, if it is not met more aslant than smooth walls are heard.
constexpr double of_one_wall_least_m = 0.05;
constexpr double of_one_wall_most_m = 0.4;
constexpr double goes_on_step_m = 0.15;  ///< less than any robot is wide
constexpr int goes_on_steps = 4;

}  // namespace

void Room::take(slam::Scan const& scan, slam::Sensor const& sensor) {
  *this = seen_from(scan.odometry);
  bool const is_sparse = slam::is_sparse(sensor);
  std::erase_if(ends_, [&](End const& end) { return !is_sparse || end.is_guess || scan.time - end.seen > remembered; });
  looked_to_ = 0.0;
  for (double const bearing : sensor.bearings_rad) looks_rad_ = std::max(looks_rad_, std::abs(bearing));
  if (looks_rad_ > looks_back_rad) looks_rad_ = std::numbers::pi;
  auto const& bearings = bearings_of(scan, sensor);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!sensor.is_reading(scan.ranges_m[i])) continue;
    double const range_m = scan.ranges_m[i];
    double const bearing = bearings[i];
    ends_.push_back(
        {.at = {range_m * std::cos(bearing) + sensor.mount_m.x(), range_m * std::sin(bearing) + sensor.mount_m.y()},
         .seen = scan.time,
         .beam = i,
         .is_guess = false});
  }
  if (sensor.half_cone_rad > 0.0F) guess_how_walls_go_on(ends_.size(), scan.time);
}

/// `heard`: how many ends there are.
void Room::guess_how_walls_go_on(std::size_t heard, slam::LogTime now) {
  for (std::size_t i = 0; i < heard; ++i) {
    auto const last = ends_[i];
    if (last.seen != now) continue;
    auto const before =
        std::ranges::find_if(ends_.begin(), ends_.begin() + static_cast<std::ptrdiff_t>(i), [&](End const& end) {
          double const apart_m = (end.at - last.at).norm();
          return end.beam == last.beam && apart_m > of_one_wall_least_m && apart_m < of_one_wall_most_m;
        });
    if (before == ends_.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    Eigen::Vector2d const along = (last.at - before->at).normalized();
    if (std::abs(along.dot(last.at.normalized())) > std::sin(slam::heard_aslant_rad)) continue;
    for (int step = 1; step <= goes_on_steps; ++step)
      ends_.push_back(
          {.at = last.at + step * goes_on_step_m * along, .seen = now, .beam = last.beam, .is_guess = true});
  }
}

Room Room::seen_from(slam::Pose2 const& odometry) const {
  auto const moved = slam::between(from_, odometry);
  slam::Turn const turn(moved.yaw);
  Room room;
  room.from_ = odometry;
  room.looks_rad_ = looks_rad_;
  room.looked_to_ = looked_to_ - moved.yaw;
  room.ends_.reserve(ends_.size());
  for (auto const& end : ends_) {
    room.ends_.push_back(end);
    room.ends_.back().at = turn.back(end.at - slam::place(moved));
  }
  return room;
}

double Room::towards(double bearing, double radius_m, double most_m) const {
  if (std::abs(geo::wrap_pi(bearing - looked_to_)) > looks_rad_) return 0.0;
  slam::Turn const turn(bearing);
  double room_m = most_m;
  for (auto const& end : ends_) {
    auto const there = turn.back(end.at);
    double const aside_m = std::abs(there.y());
    if (there.x() <= 0.0 || aside_m >= radius_m) continue;
    room_m = std::min(room_m, there.x() - std::sqrt(radius_m * radius_m - aside_m * aside_m));
  }
  return room_m;
}

}  // namespace lapwing::robot
