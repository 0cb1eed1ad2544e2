#include "scans/scan_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/scan/deskew.hpp"

namespace lapwing::scans {

namespace {

constexpr std::size_t most_beams = 20'000;
constexpr double longest_s = 1.0;  ///< from the first beam of a scan to the last

}  // namespace

std::optional<slam::Scan> lay(std::vector<float> ranges_m, slam::Sensor const& sensor, BeamTimes const& times,
                              std::function<std::optional<slam::Pose2>(std::chrono::nanoseconds)> const& pose_at) {
  auto const middle = pose_at(times.middle());
  if (!middle) return std::nullopt;
  slam::Scan scan{.time = slam::LogTime(times.middle()), .odometry = *middle, .ranges_m = std::move(ranges_m)};
  auto const from = pose_at(times.begin());
  auto const to = pose_at(times.end());
  if (!from || !to || *from == *to) return scan;
  return slam::deskewed(std::move(scan), sensor,
                        [&](std::size_t beam) { return pose_at(times.at(beam)).value_or(*middle); });
}

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

BeamTimes ScanReader::times(bus::LaserScan const& scan, std::chrono::nanoseconds first) const {
  BeamTimes times{.first = first, .beams = sensor_.bearings_rad.size()};
  double const whole_s = double{scan.time_increment} * static_cast<double>(times.beams);
  if (!(whole_s > 0.0 && whole_s <= longest_s)) return times;
  times.step = std::chrono::nanoseconds(std::llround(double{scan.time_increment} * 1e9));
  if (!is_reversed_) return times;
  times.first = times.at(times.beams - 1);
  times.step = -times.step;
  return times;
}

}  // namespace lapwing::scans
