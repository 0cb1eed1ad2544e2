#include "slam/robot_kind.hpp"

#include <algorithm>

namespace lapwing::slam {

RobotKind kind_of(ScanLog const& log, GatherOptions const& options) {
  RobotKind kind{.has_odometry = log.has_odometry, .has_times = log.has_times};
  std::vector<std::ptrdiff_t> counts;
  for (auto const& scan : log.scans) {
    auto const no_return = log.sensors[scan.sensor].no_return_m;
    counts.push_back(
        std::ranges::count_if(scan.ranges_m, [&](float range) { return range > 0.0F && range < no_return; }));
  }
  if (counts.empty()) return kind;
  auto const middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
  std::ranges::nth_element(counts, middle);
  kind.is_sparse = *middle < options.few_readings;
  return kind;
}

MapperOptions options_for(RobotKind const& kind, MapperOptions options) {
  if (!kind.is_sparse) return options;
  auto& loops = options.loops;
  loops.submap_frames = options.gather.submap_frames;
  loops.query_frames = options.gather.query_frames;
  loops.near_submaps = 2;
  loops.step_frames = 1;
  loops.least_points = 40;
  loops.least_matches = options.gather.least_matches;
  loops.least_score = options.gather.least_score;
  constexpr double drifts_more = 2.0;
  loops.rates.shift_per_sqrt_m *= drifts_more;
  loops.rates.turn_per_sqrt_m *= drifts_more;
  options.front_end.odometry_spread = options.gather.odometry_spread;
  options.front_end.point_information = options.gather.point_information;
  options.joint.in_time = 1;
  options.joint.step_trust = options.gather.step_trust;
  options.joint.point_information = options.gather.point_information;
  return options;
}

}  // namespace lapwing::slam
