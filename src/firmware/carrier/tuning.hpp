#pragma once

#include <chrono>
#include <cstdint>

#include "firmware/board_time.hpp"

namespace lapwing::firmware {

/// What depends on motors and floor. The defaults suit a body of some kilograms with geared motors at 0.3 m/s.
struct Tuning {
  /// One wheel at full voltage and no load: the feed forward. 30 % off is made good by the integral within a second.
  float full_voltage_speed_m_s = 0.4F;
  /// Of the wheels' loops. Above some 1.5 the lag of the measured speed (half of `speed_window`) makes them swing.
  float speed_gain = 0.6F;
  float speed_integral_per_s = 3.0F;
  /// Turn rate for each radian of heading error.
  float heading_gain_per_s = 2.5F;
  /// While driving only: a wheel that slips, or is worn, turns the body for as long as it drives.
  float heading_integral_per_s2 = 1.5F;
  float most_heading_integral_rad_s = 0.3F;
  float acceleration_m_s2 = 0.4F;
  float turn_acceleration_rad_s2 = 4.0F;
  float top_turn_rad_s = 1.2F;
  /// With a heading error beyond this it turns on the spot before it drives.
  float drive_error_rad = 0.5F;

  /// 5 cm (the seed's k_safe_distance), and how much more it leaves before it: where it stands, and where the way
  /// counts as free again.
  float safe_distance_m = 0.05F;
  float far_enough_m = 0.01F;
  /// From a thing's coming near to the wheels' slowing: a sonar's period and the speed loop's lag.
  float reaction_s = 0.15F;
  float retreat_speed_m_s = 0.05F;
  float longest_retreat_m = 0.2F;
  /// What is too near for a shorter time is an echo gone astray: it stops the body and does not send it back.
  Time believe_after = std::chrono::milliseconds(100);
  /// Beside the hull: what lies nearer to its sides than this is in the way.
  float side_margin_m = 0.02F;

  Time control_period = std::chrono::milliseconds(20);
  Time readings_period = std::chrono::milliseconds(100);
  Time watchdog = std::chrono::milliseconds(500);
  /// No sample of the inertial unit for so long: it is silent.
  Time imu_patience = std::chrono::milliseconds(300);
  /// Driven with this part of the voltage for so long without a pulse: the encoder or the wheel is dead.
  float dead_wheel_output = 0.15F;
  Time dead_wheel_after = std::chrono::milliseconds(500);
  /// A difference of the turn rates by wheels and by gyroscope beyond what lags and steps explain.
  float slip_rad_s = 0.4F;
  Time slip_after = std::chrono::milliseconds(300);

  /// k_speed_error and k_angle_error of the seed: 1 cm/s and 1 degree.
  float speed_error_m_s = 0.01F;
  float angle_error_rad = 0.0174533F;
  float turn_rate_error_rad_s = 0.05F;
  /// What was asked for must hold this long to be reached, so that passing through it is not.
  Time settle = std::chrono::milliseconds(200);
  std::uint8_t battery_low_percent = 15;
};

}  // namespace lapwing::firmware
