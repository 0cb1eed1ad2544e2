#include "robot/planner/room.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::robot {

namespace {

constexpr double looks_back_rad = 2.8;  ///< a beam that far from ahead

}  // namespace

Room::Room(slam::Scan const& scan, slam::Sensor const& sensor) : from_(scan.odometry) {
  for (double const bearing : sensor.bearings_rad) looks_rad_ = std::max(looks_rad_, std::abs(bearing));
  if (looks_rad_ > looks_back_rad) looks_rad_ = std::numbers::pi;
  auto const& bearings = bearings_of(scan, sensor);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    double const range_m = scan.ranges_m[i];
    if (!(range_m > 0.0) || range_m >= sensor.no_return_m) continue;
    double const bearing = bearings[i];
    ends_.emplace_back(range_m * std::cos(bearing) + sensor.mount_m.x(),
                       range_m * std::sin(bearing) + sensor.mount_m.y());
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
  for (auto const& end : ends_) room.ends_.push_back(turn.back(end - slam::place(moved)));
  return room;
}

double Room::towards(double bearing, double radius_m, double most_m) const {
  if (std::abs(geo::wrap_pi(bearing - looked_to_)) > looks_rad_) return 0.0;
  slam::Turn const turn(bearing);
  double room_m = most_m;
  for (auto const& end : ends_) {
    auto const there = turn.back(end);
    double const aside_m = std::abs(there.y());
    if (there.x() <= 0.0 || aside_m >= radius_m) continue;
    room_m = std::min(room_m, there.x() - std::sqrt(radius_m * radius_m - aside_m * aside_m));
  }
  return room_m;
}

}  // namespace lapwing::robot
