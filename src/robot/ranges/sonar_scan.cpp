#include "robot/ranges/sonar_scan.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <vector>

namespace lapwing::robot {

namespace {

struct Told {
  float bearing_rad;
  float range_m;
};

float from_axle_m(firmware::SonarPlace const& place) {
  return std::hypot(place.x_m, place.y_m);
}

Told told_by(SonarReading const& sonar, SensorFault fault, float no_return_m) {
  auto const& place = sonar.place;
  if (!is_believed(fault)) return {place.angle_rad, std::numeric_limits<float>::quiet_NaN()};
  if (!sonar.range_m) return {place.angle_rad, no_return_m};
  auto const range_m = static_cast<float>(*sonar.range_m);
  float const x_m = place.x_m + range_m * std::cos(place.angle_rad);
  float const y_m = place.y_m + range_m * std::sin(place.angle_rad);
  return {std::atan2(y_m, x_m), std::hypot(x_m, y_m)};
}

}  // namespace

std::optional<slam::Sensor> sensor_of(std::span<firmware::SonarPlace const> sonars) {
  if (sonars.empty()) return std::nullopt;
  slam::Sensor sensor{.bearings_rad = {}, .no_return_m = 0.0F};
  for (auto const& place : sonars) {
    sensor.bearings_rad.push_back(place.angle_rad);
    sensor.half_cone_rad = std::max(sensor.half_cone_rad, place.half_cone_rad);
    // Every echo is nearer to the axle than that.
    sensor.no_return_m = std::max(sensor.no_return_m, place.longest_m + from_axle_m(place));
  }
  std::ranges::sort(sensor.bearings_rad);
  return sensor;
}

slam::Scan scan_of(Sensed const& sensed, slam::Pose2 const& odometry, slam::Sensor const& sensor) {
  std::vector<Told> told;
  for (std::size_t i = 0; i < sensed.sonars.size(); ++i)
    told.push_back(told_by(sensed.sonars[i], sensed.faults.sonars[i], sensor.no_return_m));
  std::ranges::sort(told, {}, &Told::bearing_rad);
  slam::Scan scan{.time = std::chrono::duration_cast<slam::LogTime>(sensed.time), .odometry = odometry, .ranges_m = {}};
  for (auto const& [bearing_rad, range_m] : told) {
    scan.bearings_rad.push_back(bearing_rad);
    scan.ranges_m.push_back(range_m);
  }
  return scan;
}

}  // namespace lapwing::robot
