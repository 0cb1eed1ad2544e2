#include "robot/ros/scan_reader.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geo/position.hpp"

namespace lapwing::robot::ros {

namespace {

constexpr std::size_t most_beams = 20'000;
constexpr double side_m = 5.0;
constexpr double front_m = 7.5;
constexpr double half_cone_rad = 15.0 * std::numbers::pi / 180.0;

}  // namespace

std::optional<ScanReader> ScanReader::make(bus::LaserScan const& first, PlanarFrame const& mount) {
  bool const has_step = std::isfinite(first.angle_min) && std::isfinite(first.angle_increment) &&
                        first.angle_increment != 0.0F && std::isfinite(first.range_max) && first.range_max > 0.0F;
  if (!has_step || first.ranges.empty() || first.ranges.size() > most_beams) return std::nullopt;
  double const way = mount.is_upside_down ? -1.0 : 1.0;
  ScanReader reader;
  reader.is_reversed_ = way * first.angle_increment < 0.0;
  auto& bearings = reader.sensor_.bearings_rad;
  for (std::size_t i = 0; i < first.ranges.size(); ++i) {
    double const angle = first.angle_min + static_cast<double>(i) * first.angle_increment;
    bearings.push_back(static_cast<float>(mount.pose.yaw + way * angle));
  }
  if (reader.is_reversed_) std::ranges::reverse(bearings);
  reader.sensor_.mount_m = {static_cast<float>(mount.pose.x), static_cast<float>(mount.pose.y)};
  reader.sensor_.no_return_m = first.range_max;
  return reader;
}

std::optional<std::vector<float>> ScanReader::ranges(bus::LaserScan const& scan) const {
  if (scan.ranges.size() != sensor_.bearings_rad.size()) return std::nullopt;
  auto ranges = scan.ranges;
  for (auto& range : ranges) {
    if (!(range >= scan.range_min)) range = 0.0F;  // also what is no number
    range = std::min(range, sensor_.no_return_m);
  }
  if (is_reversed_) std::ranges::reverse(ranges);
  return ranges;
}

explore::SideDistances ScanReader::sides(std::vector<float> const& ranges) const {
  explore::SideDistances sides{.left_m = side_m, .front_m = front_m, .right_m = side_m};
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (ranges[i] <= 0.0F || ranges[i] >= sensor_.no_return_m) continue;
    auto const is_towards = [&](double yaw_rad) {
      return std::abs(geo::wrap_pi(sensor_.bearings_rad[i] - yaw_rad)) < half_cone_rad;
    };
    double const range_m = ranges[i];
    if (is_towards(0.0)) sides.front_m = std::min(sides.front_m, range_m);
    if (is_towards(std::numbers::pi / 2.0)) sides.left_m = std::min(sides.left_m, range_m);
    if (is_towards(-std::numbers::pi / 2.0)) sides.right_m = std::min(sides.right_m, range_m);
  }
  return sides;
}

}  // namespace lapwing::robot::ros
