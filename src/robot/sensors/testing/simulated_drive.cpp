#include "robot/sensors/testing/simulated_drive.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <Eigen/Geometry>

namespace lapwing::robot::testing {

namespace {

using namespace std::chrono_literals;
double constexpr period_s = 0.1;
/// Within a tenth of a second it is reckoned in a hundred steps: means are means.
int constexpr parts = 100;
double constexpr acceleration_m_s2 = 0.4;
double constexpr turn_acceleration_rad_s2 = 4;

double towards(double from, double to, double step) {
  return from + std::clamp(to - from, -step, step);
}

firmware::Vector3 vector3(Eigen::Vector3d const& v) {
  return {.x = static_cast<float>(v.x()), .y = static_cast<float>(v.y()), .z = static_cast<float>(v.z())};
}

}  // namespace

SimulatedDrive::SimulatedDrive(firmware::Description const& body, std::uint32_t seed, DriveErrors const& errors)
    : body_(body), errors_(errors), random_(seed) {
  auto const draw3 = [&](double deviation) {
    return Eigen::Vector3d(noise(deviation), noise(deviation), noise(deviation));
  };
  wheel_scale_ = 1 + noise(errors.wheel_scale);
  rate_bias_ = draw3(errors.rate_bias_rad_s);
  force_bias_ = draw3(errors.force_bias_m_s2);
  tilt_rad_ = {noise(errors.tilt_rad), noise(errors.tilt_rad)};
}

firmware::Readings SimulatedDrive::step(double speed_m_s, double turn_rad_s) {
  double const dt = period_s / parts;
  double const base = static_cast<double>(body_.wheel_base_m);
  double left_m = 0;
  double right_m = 0;
  double turned_rad = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int part = 0; part < parts; ++part) {
    double const before = truth_.speed_m_s;
    truth_.speed_m_s = towards(truth_.speed_m_s, speed_m_s, acceleration_m_s2 * dt);
    turn_rad_s_ = towards(turn_rad_s_, turn_rad_s, turn_acceleration_rad_s2 * dt);
    double const speed = (before + truth_.speed_m_s) / 2;
    double const middle = truth_.yaw_rad + turn_rad_s_ * dt / 2;
    truth_.x_m += speed * dt * std::cos(middle);
    truth_.y_m += speed * dt * std::sin(middle);
    truth_.yaw_rad += turn_rad_s_ * dt;
    truth_.way_m += std::abs(speed) * dt;
    turned_rad += turn_rad_s_ * dt;
    left_m += (speed - turn_rad_s_ * base / 2 + spin_m_s) * dt;
    right_m += (speed + turn_rad_s_ * base / 2 + spin_m_s) * dt;
    force += Eigen::Vector3d((truth_.speed_m_s - before) / dt, speed * turn_rad_s_, 9.80665) / parts;
  }
  time_ += 100ms;
  rate_bias_ += Eigen::Vector3d::Constant(noise(errors_.rate_bias_walk * std::sqrt(period_s)));
  double const pulses_per_m = static_cast<double>(body_.pulses_per_m) * wheel_scale_;
  left_pulses_ += left_m * pulses_per_m * (1 + noise(errors_.wheel_slip));
  right_pulses_ += right_m * pulses_per_m * (1 + noise(errors_.wheel_slip));

  // The unit is screwed in a little askew.
  Eigen::Matrix3d const askew = (Eigen::AngleAxisd(tilt_rad_.x(), Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(tilt_rad_.y(), Eigen::Vector3d::UnitY()))
                                    .toRotationMatrix();
  auto const noise3 = [&](double deviation) {
    return Eigen::Vector3d(noise(deviation), noise(deviation), noise(deviation));
  };
  Eigen::Vector3d const rate =
      askew * Eigen::Vector3d(0, 0, turned_rad / period_s) + rate_bias_ + noise3(errors_.rate_noise_rad_s);
  measured_yaw_rad_ += rate.z() * period_s;

  firmware::Readings readings;
  readings.time = time_;
  readings.left_pulses = static_cast<std::int32_t>(std::floor(left_pulses_));
  readings.right_pulses = static_cast<std::int32_t>(std::floor(right_pulses_));
  readings.imu =
      firmware::Imu{.orientation = {.w = static_cast<float>(std::cos(measured_yaw_rad_ / 2)),
                                    .x = 0,
                                    .y = 0,
                                    .z = static_cast<float>(std::sin(measured_yaw_rad_ / 2))},
                    .rate_rad_s = vector3(rate),
                    .acceleration_m_s2 = vector3(askew * force + force_bias_ + noise3(errors_.force_noise_m_s2))};
  return readings;
}

}  // namespace lapwing::robot::testing
