#include "slam/scan/deskew.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/assert.hpp"

namespace lapwing::slam {

Scan deskewed(Scan scan, Sensor const& sensor, std::function<Pose2(std::size_t beam)> const& pose_of) {
  auto const count = scan.ranges_m.size();
  LAPWING_ASSERT(count == sensor.bearings_rad.size() && scan.bearings_rad.empty(), count, sensor.bearings_rad.size());
  if (count < 2) return scan;
  Eigen::Vector2d const mount = sensor.mount_m.cast<double>();
  double const span = double{sensor.bearings_rad.back()} - double{sensor.bearings_rad.front()};
  double const half_step = 0.5 * span / static_cast<double>(count - 1);
  double const first = double{sensor.bearings_rad.front()} - half_step;
  double const last = double{sensor.bearings_rad.back()} + half_step;
  std::vector<std::pair<float, float>> beams;  // bearings with their ranges
  for (std::size_t beam = 0; beam < count; ++beam) {
    constexpr double far_m = 1e3;  // where a beam that saw nothing ends
    auto const range = scan.ranges_m[beam];
    bool const is_seen = sensor.is_reading(range);
    double const reach = is_seen ? double{range} : far_m;
    double const bearing = sensor.bearings_rad[beam];
    Eigen::Vector2d const end = mount + reach * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    auto const moved = between(scan.odometry, pose_of(beam) * Pose2{end.x(), end.y(), 0.0});
    Eigen::Vector2d const seen = place(moved) - mount;
    double const looked = first + geo::wrap_two_pi(std::atan2(seen.y(), seen.x()) - first);
    auto const seen_m = looked <= last ? static_cast<float>(seen.norm()) : 0.0F;
    beams.emplace_back(static_cast<float>(std::min(looked, last)), is_seen ? seen_m : range);
  }
  std::ranges::sort(beams, {}, &std::pair<float, float>::first);
  for (std::size_t beam = 0; beam < count; ++beam) {
    scan.bearings_rad.push_back(beams[beam].first);
    scan.ranges_m[beam] = beams[beam].second;
  }
  return scan;
}

}  // namespace lapwing::slam
