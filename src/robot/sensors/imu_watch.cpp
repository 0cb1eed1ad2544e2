#include "robot/sensors/imu_watch.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "robot/sensors/attitude.hpp"

namespace lapwing::robot {

namespace {

int constexpr missing_that_tell = 3;
int constexpr same_that_tell = 10;
/// Two turns a second, and four times its weight: a body with wheels is not driven like that, but thrown.
double constexpr possible_rate_rad_s = 4 * std::numbers::pi;
double constexpr possible_force_m_s2 = 40;
/// Between what the rate says of the yaw and what the orientation says: bias and lag make some degrees, not these.
double constexpr possible_yaw_error_rad = 0.35;

double length(firmware::Vector3 const& v) {
  return std::sqrt(static_cast<double>(v.x) * v.x + static_cast<double>(v.y) * v.y + static_cast<double>(v.z) * v.z);
}

}  // namespace

SensorFault ImuWatch::feed(firmware::Readings const& readings) {
  if (!readings.imu) {
    ++missing_;
    return missing_ >= missing_that_tell ? SensorFault::dropouts : SensorFault::none;
  }
  missing_ = 0;
  auto const& imu = *readings.imu;
  auto const before = last_;
  last_ = Last{.time = readings.time, .imu = imu};
  if (length(imu.rate_rad_s) > possible_rate_rad_s || length(imu.acceleration_m_s2) > possible_force_m_s2)
    return SensorFault::jumping;
  if (!before || readings.time <= before->time) return SensorFault::none;
  same_ = before->imu == imu ? same_ + 1 : 0;
  if (same_ >= same_that_tell) return SensorFault::stuck;
  double const period_s = std::chrono::duration<double>(readings.time - before->time).count();
  double const turned = attitude(imu.orientation).yaw_rad - attitude(before->imu.orientation).yaw_rad;
  double const error = std::remainder(turned - static_cast<double>(imu.rate_rad_s.z) * period_s, 2 * std::numbers::pi);
  return std::abs(error) > possible_yaw_error_rad ? SensorFault::jumping : SensorFault::none;
}

}  // namespace lapwing::robot
