#include "robot/ranges/scan_laying.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "slam/scan/deskew.hpp"

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
  auto const taken = scan.time + from_seconds(0.5 * double{laser.scan_duration_s});
  slam::Scan laid{.time = std::chrono::duration_cast<slam::LogTime>(taken),
                  .odometry = odometry.at(taken),
                  .ranges_m = {scan.ranges_m.begin(), scan.ranges_m.end()}};
  std::ranges::replace(laid.ranges_m, 0.0F, laser.longest_m);  // where nothing was seen
  bool const is_clockwise = laser.step_rad < 0.0F;
  if (is_clockwise) std::ranges::reverse(laid.ranges_m);
  return slam::deskewed(std::move(laid), sensor, [&](std::size_t beam) {
    return odometry.at(time_of(is_clockwise ? count - 1 - beam : beam, scan, laser));
  });
}

}  // namespace lapwing::robot
