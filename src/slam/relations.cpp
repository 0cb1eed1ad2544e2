#include "slam/relations.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/assert.hpp"
#include "slam/readers/text_lines.hpp"

namespace lapwing::slam {
namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

Spread spread_of(std::vector<double> const& errors) {
  Spread spread;
  if (errors.empty()) return spread;
  auto const count = static_cast<double>(errors.size());
  for (auto const error : errors) {
    spread.mean += error / count;
    spread.mean_square += error * error / count;
    spread.most = std::max(spread.most, error);
  }
  for (auto const error : errors) spread.deviation += (error - spread.mean) * (error - spread.mean);
  spread.deviation = errors.size() > 1 ? std::sqrt(spread.deviation / (count - 1.0)) : 0.0;
  return spread;
}

std::size_t after(std::span<TimedPose const> trajectory, LogTime time) {
  return static_cast<std::size_t>(std::ranges::upper_bound(trajectory, time, {}, &TimedPose::time) -
                                  trajectory.begin());
}

Pose2 nearest(std::span<TimedPose const> trajectory, LogTime time) {
  auto const next = after(trajectory, time);
  if (next == 0) return trajectory.front().pose;
  if (next == trajectory.size()) return trajectory.back().pose;
  auto const is_next = trajectory[next].time - time < time - trajectory[next - 1].time;
  return trajectory[is_next ? next : next - 1].pose;
}

Pose2 interpolated(std::span<TimedPose const> trajectory, LogTime time) {
  auto const next = after(trajectory, time);
  if (next == 0) return trajectory.front().pose;
  if (next == trajectory.size()) return trajectory.back().pose;
  auto const& a = trajectory[next - 1];
  auto const& b = trajectory[next];
  auto const share = (time - a.time) / (b.time - a.time);
  return {a.pose.x + share * (b.pose.x - a.pose.x), a.pose.y + share * (b.pose.y - a.pose.y),
          a.pose.yaw + share * geo::wrap_pi(b.pose.yaw - a.pose.yaw)};
}

template <class PoseAt, class Error>
RelationErrors errors_of(std::span<TimedPose const> trajectory, std::span<Relation const> relations, PoseAt pose_at,
                         Error error) {
  LAPWING_ASSERT(!trajectory.empty());
  std::vector<double> shifts;
  std::vector<double> turns;
  for (auto const& relation : relations) {
    auto const estimated = between(pose_at(trajectory, relation.first), pose_at(trajectory, relation.second));
    shifts.push_back(error(estimated, relation.motion));
    turns.push_back(degrees * turn_rad(estimated, relation.motion));
  }
  return {.shift_m = spread_of(shifts), .turn_deg = spread_of(turns)};
}

}  // namespace

base::Result<std::vector<Relation>> read_relations(std::string_view text) {
  std::vector<Relation> relations;
  Lines lines(text);
  while (auto const line = lines.next()) {
    Words first(*line);
    if (auto const word = first.next(); word.empty() || word.starts_with('#')) continue;
    Words words(*line);
    double values[8];
    for (auto& value : values) {
      auto const number = words.finite();
      if (!number) return fail_at(lines.number(), "expected the eight numbers t1 t2 x y z roll pitch yaw");
      value = *number;
    }
    relations.push_back({LogTime(values[0]), LogTime(values[1]), {values[2], values[3], values[7]}});
  }
  if (relations.empty()) return base::fail(base::ErrorKind::invalid_input, "no relation");
  return relations;
}

RelationErrors component_errors(std::span<TimedPose const> trajectory, std::span<Relation const> relations) {
  return errors_of(trajectory, relations, nearest, distance_m);
}

RelationErrors motion_errors(std::span<TimedPose const> trajectory, std::span<Relation const> relations) {
  // (p1^-1 p2) expected^-1: its shift depends on the direction of the pair, as its authors remark.
  return errors_of(trajectory, relations, interpolated, [](Pose2 const& estimated, Pose2 const& expected) {
    return place(estimated * inverse(expected)).norm();
  });
}

}  // namespace lapwing::slam
