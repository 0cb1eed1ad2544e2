#include "sim/building/sensors/imu.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace lapwing::sim::building {

namespace {

constexpr double gravity_m_s2 = 9.80665;

}  // namespace

Imu::Imu(ImuSettings const& settings, std::uint64_t seed, std::uint32_t robot)
    : settings_(settings), noise_(seed, "imu", robot) {
  scale_ = 1.0 + settings.gyro_scale * noise_.gaussian();
  bias_rad_s_ = settings.gyro_bias_rad_s * noise_.gaussian();
  for (auto& tilt : tilt_rad_) tilt = settings.tilt_rad * noise_.gaussian();
  for (auto& bias : acceleration_bias_m_s2_) bias = settings.acceleration_bias_m_s2 * noise_.gaussian();
}

Imu::Sample Imu::sense(double seconds, DrivenBody const& body) {
  bias_rad_s_ += settings_.gyro_drift_rad_s_sqrt_s * std::sqrt(seconds) * noise_.gaussian();
  double const rate = scale_ * body.turn_rad_s() + bias_rad_s_;
  yaw_rad_ += rate * seconds;
  Eigen::Quaterniond const level_from_body = Eigen::AngleAxisd(yaw_rad_, Eigen::Vector3d::UnitZ()) *
                                             Eigen::AngleAxisd(tilt_rad_[1], Eigen::Vector3d::UnitY()) *
                                             Eigen::AngleAxisd(tilt_rad_[0], Eigen::Vector3d::UnitX());
  Sample sample;
  sample.orientation = {level_from_body.w(), level_from_body.x(), level_from_body.y(), level_from_body.z()};
  Eigen::Vector3d const up = level_from_body.conjugate() * Eigen::Vector3d(0.0, 0.0, gravity_m_s2);
  std::array const force{up.x() + body.acceleration_m_s2(), up.y() + body.speed_m_s() * body.turn_rad_s(), up.z()};
  for (std::size_t i = 0; i < 3; ++i) {
    sample.rate_rad_s[i] = (i == 2 ? rate : 0.0) + settings_.gyro_noise_rad_s * noise_.gaussian();
    sample.acceleration_m_s2[i] =
        force[i] + acceleration_bias_m_s2_[i] + settings_.acceleration_noise_m_s2 * noise_.gaussian();
  }
  return sample;
}

}  // namespace lapwing::sim::building
