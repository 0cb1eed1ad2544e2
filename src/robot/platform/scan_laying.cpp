#include "robot/platform/scan_laying.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "base/assert.hpp"

namespace lapwing::robot {

namespace {

firmware::Time from_seconds(double seconds) {
  return std::chrono::duration_cast<firmware::Time>(std::chrono::duration<double>(seconds));
}

firmware::Time time_of(std::size_t beam, LaserRanges const& scan, firmware::LaserPlace const& laser) {
  double const share = laser.beams > 1 ? static_cast<double>(beam) / (laser.beams - 1) : 0.0;
  return scan.time + from_seconds(share * double{laser.scan_duration_s});
}

}  // namespace

slam::Sensor sensor_of(firmware::LaserPlace const& laser) {
  slam::Sensor sensor;
  sensor.mount_m = {laser.x_m, laser.y_m};
  sensor.no_return_m = laser.longest_m;
  for (int i = 0; i < laser.beams; ++i)
    sensor.bearings_rad.push_back(laser.first_angle_rad + laser.step_rad * static_cast<float>(i));
  if (laser.step_rad < 0.0F) std::ranges::reverse(sensor.bearings_rad);
  return sensor;
}

firmware::Time end_of(LaserRanges const& scan, firmware::LaserPlace const& laser) {
  return scan.time + from_seconds(double{laser.scan_duration_s});
}

slam::Scan lay(LaserRanges const& scan, firmware::LaserPlace const& laser, slam::Sensor const& sensor,
               BoardOdometry const& odometry) {
  auto const count = scan.ranges_m.size();
  LAPWING_ASSERT(count == sensor.bearings_rad.size(), count, sensor.bearings_rad.size());
  auto const taken = scan.time + from_seconds(0.5 * double{laser.scan_duration_s});
  auto const reference = odometry.at(taken);
  Eigen::Vector2d const mount(laser.x_m, laser.y_m);
  double const step = std::abs(double{laser.step_rad});
  double const first = double{sensor.bearings_rad.front()} - 0.5 * step;
  double const last = double{sensor.bearings_rad.back()} + 0.5 * step;
  std::vector<std::pair<float, float>> beams;  // bearings with their ranges
  for (std::size_t beam = 0; beam < count; ++beam) {
    double const bearing = scan.first_angle_rad + scan.step_rad * static_cast<double>(beam);
    bool const is_seen = scan.ranges_m[beam] > 0.0;
    double const range_m = is_seen ? scan.ranges_m[beam] : double{laser.longest_m};
    Eigen::Vector2d const end = mount + range_m * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    auto const moved =
        slam::between(reference, odometry.at(time_of(beam, scan, laser)) * slam::Pose2{end.x(), end.y(), 0.0});
    Eigen::Vector2d const seen = slam::place(moved) - mount;
    double const looked = first + geo::wrap_two_pi(std::atan2(seen.y(), seen.x()) - first);
    bool const is_within = looked <= last;
    beams.emplace_back(std::min(looked, last), is_seen && is_within ? seen.norm() : double{laser.longest_m});
  }
  std::ranges::sort(beams);
  slam::Scan laid{.time = std::chrono::duration_cast<slam::LogTime>(taken), .odometry = reference, .ranges_m = {}};
  for (auto const& [bearing, range_m] : beams) {
    laid.bearings_rad.push_back(bearing);
    laid.ranges_m.push_back(range_m);
  }
  return laid;
}

}  // namespace lapwing::robot
