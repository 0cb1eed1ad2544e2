#include "robot/platform/thoughts.hpp"

#include <cmath>
#include <utility>

#include "robot/mapping/pose_check.hpp"

namespace lapwing::robot {

namespace {

std::vector<Place> ends_of(slam::Scan const& scan, slam::Sensor const& sensor, slam::Pose2 const& pose) {
  std::vector<Place> ends;
  auto const& bearings = bearings_of(scan, sensor);
  slam::Turn const turn(pose.yaw);
  Eigen::Vector2d const from = slam::place(pose) + turn * sensor.mount_m.cast<double>();
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (!sensor.is_reading(scan.ranges_m[i])) continue;
    double const range_m = scan.ranges_m[i];
    double const bearing = pose.yaw + double{bearings[i]};
    ends.emplace_back(from.x() + range_m * std::cos(bearing), from.y() + range_m * std::sin(bearing));
  }
  return ends;
}

}  // namespace

MapResult take_in(std::unique_ptr<Thoughts> thoughts, MapInput input) {
  auto& map = thoughts->map;
  MapResult result;
  auto const last = input.scans.back();
  if (!input.aligned.empty()) map.take(input.aligned);
  for (auto& scan : input.scans) {
    thoughts->room.take(scan, map.sensor());
    auto const pose = map.here().pose * slam::between(map.odometry(), scan.odometry);
    map.add(without_robots(std::move(scan), map.sensor(), pose, input.others));
  }
  result.changed = map.take_changes();
  if (!result.changed.empty()) result.grid = map.grid();
  result.shifts = map.take_shifts();
  result.here = map.here();
  result.odometry = map.odometry();
  result.seen = ends_of(last, map.sensor(), result.here.pose);
  result.misfit = misfit(map.grid(), result.seen);
  result.thoughts = std::move(thoughts);
  return result;
}

PlanResult plan_on(MapResult map, std::uint64_t errand, PlanInput input) {
  auto& planner = map.thoughts->planner;
  auto& floor = map.thoughts->map;
  planner.learn(floor.grid(), map.changed);
  PlanResult result;
  result.errand = errand;
  std::optional<base::Error> refused;
  if (input.errand) {
    result.errand = input.errand->number;
    if (auto begun = planner.begin(std::move(input.errand->errand)); !begun) refused = begun.error();
  }
  if (input.companions) planner.meet(*input.companions, floor.grid());
  if (refused) {
    result.plan = {.state = Plan::State::failed, .reason = refused->message};
  } else {
    auto const way = floor.way();
    result.plan = planner.plan({.pose = map.here.pose,
                                .driven_m = input.driven_m,
                                .time_s = input.time_s,
                                .sides = input.sides,
                                .seen = map.seen,
                                .room = map.thoughts->room,
                                .driven = way});
  }
  if (input.wants_survey) {
    result.survey = planner.survey();
    result.home_m = planner.home_m({map.here.pose.x, map.here.pose.y});
  }
  if (input.wants_walls) result.walls = map.thoughts->walls.take(slam::find_walls(floor.grid()));
  if (input.may_align && floor.wants_alignment(input.aligns_soon)) result.alignment = floor.begin_alignment();
  result.map = std::move(map);
  return result;
}

std::unique_ptr<slam::JointAlignment> go_on_aligning(std::unique_ptr<slam::JointAlignment> alignment) {
  constexpr std::size_t most_pairs = 2000;
  alignment->go_on(most_pairs, slam::one_by_one);
  return alignment;
}

}  // namespace lapwing::robot
