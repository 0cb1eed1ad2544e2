#pragma once

#include <array>
#include <cstdint>

#include "sim/building/body/drive.hpp"
#include "sim/building/noise.hpp"

namespace lapwing::sim::building {

struct ImuSettings {
  double period_s = 0.01;
  double gyro_noise_rad_s = 0.003;             ///< standard deviation of a sample
  double gyro_bias_rad_s = 0.00015;            ///< standard deviation of what it begins with: half a degree a minute
  double gyro_drift_rad_s_sqrt_s = 0.000'005;  ///< of the bias' random walk
  double gyro_scale = 0.001;                   ///< standard deviation: a turn is told as so much more
  double acceleration_noise_m_s2 = 0.05;
  double acceleration_bias_m_s2 = 0.03;
  double tilt_rad = 0.005;  ///< standard deviation of how straight it was screwed on
};

/// An inertial unit that works out its orientation itself, without a compass: yaw is what its gyroscope adds up to.
class Imu {
 public:
  Imu(ImuSettings const& settings, std::uint64_t seed, std::uint32_t robot);

  struct Sample {
    std::array<double, 4> orientation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z: body to level
    std::array<double, 3> rate_rad_s{};
    std::array<double, 3> acceleration_m_s2{};
  };
  /// After `seconds` in which the body moved as it says.
  [[nodiscard]] Sample sense(double seconds, DrivenBody const& body);
  [[nodiscard]] ImuSettings const& settings() const { return settings_; }

 private:
  ImuSettings settings_;
  Noise noise_;
  double scale_ = 1.0;
  double bias_rad_s_ = 0.0;
  std::array<double, 2> tilt_rad_{};  ///< roll, pitch
  std::array<double, 3> acceleration_bias_m_s2_{};
  double yaw_rad_ = 0.0;
};

}  // namespace lapwing::sim::building
