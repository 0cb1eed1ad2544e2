#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include <Eigen/Core>

#include "firmware/frames/records.hpp"

namespace lapwing::robot::testing {

/// How the sensors of a simulated drive are wrong. The defaults: wheels half a per cent off and slipping by 2 % at
/// random, and a MEMS unit that was never calibrated.
struct DriveErrors {
  double wheel_scale = 0.005;  ///< of both, standard deviation
  double wheel_slip = 0.02;    ///< of each step of each wheel
  double rate_noise_rad_s = 2e-4;
  double rate_bias_rad_s = 0.02;
  double rate_bias_walk = 2e-6;  ///< in a square root of a second
  double force_noise_m_s2 = 0.03;
  double force_bias_m_s2 = 0.15;
  double tilt_rad = 0.01;  ///< of the unit in the body, about both axes
};

struct TruePose {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double speed_m_s = 0;
  double way_m = 0;
};

/// Drives on a level floor and says what a board would, ten times a second.
class SimulatedDrive {
 public:
  SimulatedDrive(firmware::Description const& body, std::uint32_t seed, DriveErrors const& errors = {});

  /// Changes speed and turn rate to these with the body's accelerations, and goes on for a tenth of a second.
  [[nodiscard]] firmware::Readings step(double speed_m_s, double turn_rad_s);
  [[nodiscard]] TruePose const& truth() const { return truth_; }

  /// The wheels turn, the floor is not moved by them.
  double spin_m_s = 0;

 private:
  [[nodiscard]] double noise(double deviation) { return std::normal_distribution<double>(0, deviation)(random_); }

  firmware::Description body_;
  DriveErrors errors_;
  std::mt19937 random_;
  TruePose truth_;
  double turn_rad_s_ = 0;
  double wheel_scale_ = 1;
  Eigen::Vector3d rate_bias_;
  Eigen::Vector3d force_bias_;
  Eigen::Vector2d tilt_rad_;
  double measured_yaw_rad_ = 0;
  double left_pulses_ = 0;
  double right_pulses_ = 0;
  firmware::Time time_{};
};

/// A round through an office: down corridors, around corners by the left and the right, a stop at each fourth corner as
/// at a door. `each` gets the readings of every tenth of a second.
template <class Each>
void office_round(SimulatedDrive& drive, int corners, Each const& each) {
  auto const hold = [&](int steps, double speed_m_s, double turn_rad_s) {
    for (int i = 0; i < steps; ++i) each(drive.step(speed_m_s, turn_rad_s));
  };
  hold(50, 0, 0);
  for (int corner = 0; corner < corners; ++corner) {
    hold(150, 0.16, 0);
    double const side = corner % 3 == 2 ? -1.0 : 1.0;
    hold(20, 0.0, 0.0);
    hold(20, 0.0, 0.8 * side);
    hold(5, 0.0, 0.0);
    hold(40, 0.3, 0.1 * side);
    if (corner % 4 == 3) hold(50, 0, 0);
  }
  hold(10, 0, 0);
}

}  // namespace lapwing::robot::testing
