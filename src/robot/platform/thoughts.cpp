#include "robot/platform/thoughts.hpp"

#include <cmath>
#include <utility>

namespace lapwing::robot {

namespace {

std::vector<Place> ends_of(slam::Scan const& scan, slam::Sensor const& sensor, slam::Pose2 const& pose) {
  std::vector<Place> ends;
  slam::Turn const turn(pose.yaw);
  Eigen::Vector2d const from = slam::place(pose) + turn * sensor.mount_m.cast<double>();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    double const range_m = scan.ranges_m[i];
    if (!(range_m > 0.0) || range_m >= sensor.no_return_m) continue;
    double const bearing = pose.yaw + double{sensor.bearings_rad[i]};
    ends.emplace_back(from.x() + range_m * std::cos(bearing), from.y() + range_m * std::sin(bearing));
  }
  return ends;
}

}  // namespace

ThoughtResult think(std::unique_ptr<Thoughts> thoughts, std::uint64_t errand, ThoughtInput input) {
  auto& map = thoughts->map;
  auto& planner = thoughts->planner;
  auto const last = input.scans.back();
  for (auto& scan : input.scans) map.add(std::move(scan));
  ThoughtResult result;
  result.changed = map.take_changes();
  if (!result.changed.empty()) {
    planner.learn(map.grid(), result.changed);
    result.grid = map.grid();
  }
  result.here = map.here();
  result.odometry = map.odometry();
  result.errand = errand;
  auto const& driven = map.graph().poses;
  std::optional<base::Error> refused;
  if (input.errand) {
    result.errand = input.errand->number;
    if (auto begun = planner.begin(std::move(input.errand->errand)); !begun) refused = begun.error();
  }
  if (refused) {
    result.plan = {.state = Plan::State::failed, .reason = refused->message};
  } else {
    result.plan = planner.plan({.pose = result.here.pose,
                                .driven_m = input.driven_m,
                                .time_s = input.time_s,
                                .sides = input.sides,
                                .seen = ends_of(last, map.sensor(), result.here.pose),
                                .room = Room(last, map.sensor()),
                                .driven = driven});
  }
  if (input.wants_survey) result.survey = planner.survey();
  result.thoughts = std::move(thoughts);
  return result;
}

}  // namespace lapwing::robot
