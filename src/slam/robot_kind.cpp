#include "slam/robot_kind.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::slam {
namespace {

double middle_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

double scan_step_m(std::vector<Scan> const& scans) {
  constexpr double still_m = 0.02;
  std::vector<double> steps;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    auto const step = distance_m(scans[i - 1].odometry, scans[i].odometry);
    if (step > still_m) steps.push_back(step);
  }
  return middle_of(std::move(steps));
}

/// As long a stretch of the way in fewer key frames.
void count_by_way(MapperOptions& options, double share) {
  auto const fewer = [&](int& count, int least) {
    count = std::max(std::min(least, count), static_cast<int>(std::lround(share * count)));
  };
  fewer(options.loops.submap_frames, options.gather.submap_frames);
  fewer(options.loops.query_frames, options.gather.query_frames);
  fewer(options.loops.near_submaps, 1);
  fewer(options.loops.step_frames, 1);
  fewer(options.joint.in_time, 1);
}

}  // namespace

RobotKind kind_of(ScanLog const& log, GatherOptions const& options) {
  RobotKind kind{.has_odometry = log.has_odometry, .has_times = log.has_times};
  std::vector<double> counts;
  for (auto const& scan : log.scans) {
    auto const& sensor = log.sensors[scan.sensor];
    counts.push_back(static_cast<double>(
        std::ranges::count_if(scan.ranges_m, [&](float range) { return sensor.is_reading(range); })));
  }
  kind.is_sparse = !counts.empty() && middle_of(std::move(counts)) < options.few_readings;
  kind.scan_step_m = scan_step_m(log.scans);
  return kind;
}

MapperOptions options_for(RobotKind const& kind, MapperOptions options) {
  // A laser's key frames are about so far apart on the way, those of turns on the spot among them.
  constexpr double usual_step_m = 0.3;
  if (!kind.is_sparse && kind.scan_step_m > usual_step_m) count_by_way(options, usual_step_m / kind.scan_step_m);
  if (!kind.is_sparse) return options;
  auto& loops = options.loops;
  loops.submap_frames = options.gather.submap_frames;
  loops.query_frames = options.gather.query_frames;
  // Scans are gathered over `least_m` of the way. From end to end that is a little less where the robot turned, and to
  // look after just as much would pass over every other key frame.
  constexpr double of_a_key_frame = 0.8;
  loops.every_m = std::min(loops.every_m, of_a_key_frame * options.gather.least_m);
  loops.near_submaps = 2;
  loops.step_frames = 1;
  loops.least_points = 40;
  loops.least_matches = options.gather.least_matches;
  loops.least_score = options.gather.least_score;
  constexpr double drifts_more = 2.0;
  loops.rates.shift_per_sqrt_m *= drifts_more;
  loops.rates.turn_per_sqrt_m *= drifts_more;
  // Few readings leave much unseen at every step, and what that adds up to is in the rates.
  loops.rates.unseen_share = 0.0;
  options.front_end.may_slip = false;
  options.front_end.odometry_spread = options.gather.odometry_spread;
  options.front_end.point_information = options.gather.point_information;
  options.joint.in_time = 1;
  options.joint.point_information = options.gather.point_information;
  return options;
}

}  // namespace lapwing::slam
