#include "scans/scan_reader.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/scan/deskew.hpp"

namespace lapwing::scans {

namespace {

constexpr std::size_t most_beams = 20'000;
constexpr double longest_s = 1.0;  ///< from the first beam of a scan to the last
constexpr double same_rad = 0.1;   ///< by which the ends of what one laser sees may differ from turn to turn
constexpr double same_surface_m = 0.1;
constexpr double same_surface = 0.05;  ///< of the range: so far apart neighbours on a wall met aslant are

bool is_same_surface(float one, float other) {
  return std::abs(one - other) <= same_surface_m + same_surface * std::min(one, other);
}

/// What is seen at a place between beams: of two that see one surface the share of each, else that of the nearer one.
float range_at(std::vector<float> const& ranges, double place, slam::Sensor const& sensor) {
  auto const last = static_cast<double>(ranges.size() - 1);
  if (place < -0.5 || place > last + 0.5) return 0.0F;
  double const inside = std::clamp(place, 0.0, last);
  float const lower = ranges[static_cast<std::size_t>(inside)];
  float const upper = ranges[static_cast<std::size_t>(std::ceil(inside))];
  auto const share = static_cast<float>(inside - std::floor(inside));
  bool const both = sensor.is_reading(lower) && sensor.is_reading(upper);
  if (both && is_same_surface(lower, upper)) return std::lerp(lower, upper, share);
  return share < 0.5F ? lower : upper;
}

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
  reader.first_rad_ = first.angle_min;
  reader.step_rad_ = first.angle_increment;
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

bool ScanReader::fits(bus::LaserScan const& scan) const {
  auto const count = scan.ranges.size();
  auto const beams = sensor_.bearings_rad.size();
  if (2 * count < beams || count > 2 * beams) return false;
  double const begins_off = double{scan.angle_min} - first_rad_;
  double const ends_off =
      begins_off + double{scan.angle_increment} * static_cast<double>(count) - step_rad_ * static_cast<double>(beams);
  bool const looks_alike = std::abs(begins_off) <= same_rad && std::abs(ends_off) <= same_rad;
  return looks_alike && double{scan.angle_increment} * step_rad_ > 0.0;
}

std::optional<std::vector<float>> ScanReader::ranges(bus::LaserScan const& scan) const {
  if (!fits(scan)) return std::nullopt;
  auto ranges = scan.ranges;
  for (auto& range : ranges) {
    if (!(range >= scan.range_min)) range = 0.0F;  // also what is no number
    range = std::min(range, sensor_.no_return_m);
  }
  auto const beams = sensor_.bearings_rad.size();
  bool const is_as_first = ranges.size() == beams && scan.angle_min == first_rad_ && scan.angle_increment == step_rad_;
  if (!is_as_first) {
    auto const told = std::exchange(ranges, std::vector<float>(beams));
    for (std::size_t i = 0; i < beams; ++i) {
      double const angle = first_rad_ + static_cast<double>(i) * step_rad_;
      ranges[i] = range_at(told, (angle - double{scan.angle_min}) / double{scan.angle_increment}, sensor_);
    }
  }
  if (is_reversed_) std::ranges::reverse(ranges);
  return ranges;
}

BeamTimes ScanReader::times(bus::LaserScan const& scan, std::chrono::nanoseconds first) const {
  BeamTimes times{.first = first, .beams = sensor_.bearings_rad.size()};
  double const whole_s = double{scan.time_increment} * static_cast<double>(scan.ranges.size());
  if (!(whole_s > 0.0 && whole_s <= longest_s)) return times;
  times.step = std::chrono::nanoseconds(std::llround(whole_s / static_cast<double>(times.beams) * 1e9));
  if (!is_reversed_) return times;
  times.first = times.at(times.beams - 1);
  times.step = -times.step;
  return times;
}

}  // namespace lapwing::scans
