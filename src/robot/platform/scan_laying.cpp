#include "robot/platform/scan_laying.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

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
  auto const beams = scan.ranges_m.size();
  LAPWING_ASSERT(beams == sensor.bearings_rad.size(), beams, sensor.bearings_rad.size());
  auto const taken = scan.time + from_seconds(0.5 * double{laser.scan_duration_s});
  auto const reference = odometry.at(taken);
  slam::Scan laid{.time = std::chrono::duration_cast<slam::LogTime>(taken),
                  .odometry = reference,
                  .ranges_m = std::vector<float>(beams, laser.longest_m)};
  Eigen::Vector2d const mount(laser.x_m, laser.y_m);
  double const step = std::abs(double{laser.step_rad});
  double const first = sensor.bearings_rad.front();
  bool const goes_round = step * static_cast<double>(beams) > 2.0 * std::numbers::pi - 0.5 * step;
  for (std::size_t beam = 0; beam < beams; ++beam) {
    if (scan.ranges_m[beam] <= 0.0) continue;
    double const bearing = scan.first_angle_rad + scan.step_rad * static_cast<double>(beam);
    Eigen::Vector2d const end = mount + scan.ranges_m[beam] * Eigen::Vector2d(std::cos(bearing), std::sin(bearing));
    auto const moved =
        slam::between(reference, odometry.at(time_of(beam, scan, laser)) * slam::Pose2{end.x(), end.y(), 0.0});
    Eigen::Vector2d const seen = slam::place(moved) - mount;
    // A direction just before the first beam is that beam's, too.
    double const turned = geo::wrap_two_pi(std::atan2(seen.y(), seen.x()) - first + 0.5 * step);
    auto index = static_cast<std::size_t>(turned / step);
    if (goes_round) index %= beams;
    if (index >= beams) continue;
    laid.ranges_m[index] = std::min(laid.ranges_m[index], static_cast<float>(seen.norm()));
  }
  return laid;
}

}  // namespace lapwing::robot
