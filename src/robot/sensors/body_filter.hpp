#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "firmware/board_time.hpp"

namespace lapwing::robot {

/// How good the sensors are, as standard deviations. The defaults are a MEMS unit of the MPU-6050's kind, whose values
/// are means over a tenth of a second (0.005 deg/s/√Hz, 400 ug/√Hz by its data sheet, several times that for
/// vibration), and geared wheels on a hard floor.
struct FilterNoise {
  double rate_rad_s = 1e-3;
  double acceleration_m_s2 = 0.05;
  double rate_bias_walk = 3e-6;  ///< rad/s in a square root of a second
  double acceleration_bias_walk = 1e-3;
  double first_rate_bias_rad_s = 0.05;
  double first_acceleration_bias_m_s2 = 0.3;
  double first_tilt_rad = 0.03;

  double wheel_speed_m_s = 0.003;
  double wheel_speed_part = 0.01;  ///< of the speed
  double sideways_m_s = 0.01;      ///< how little a body with wheels slides to a side or leaves the floor
  double standing_m_s = 0.001;
  double wheel_turn_rad_s = 0.03;  ///< of the turn rate by wheels, where the gyroscope is not heard
};

/// Where the body is and how it moves, from wheels, gyroscope and accelerometer: an error-state Kalman filter.
///
/// Nominal state: position p, velocity v (odometry frame, z up), orientation q (body to odometry), biases a_b and ω_b.
/// Error state, in this order: δp, δv, δθ (in the body), δa_b, δω_b. After J. Solà, "Quaternion kinematics for the
/// error-state Kalman filter" (2017, arXiv:1711.02508): section 5.4 for the prediction, 6.1 for the correction, 6.2
/// and 6.3 for the injection and the reset, with local angular errors. Gravity is known and no part of the state. The
/// wheels are observed as a velocity of the body that has no sideways part (a nonholonomic constraint, Dissanayake et
/// al. 2001).
///
/// Position and yaw are considered, not estimated (S. F. Schmidt, "Application of state-space methods to navigation
/// problems", 1966): nothing that is learned later moves them back to where they should have been. Who follows them is
/// told a motion where there is one, and corrects by the map what has added up (REP 105's `odom`).
class BodyFilter {
 public:
  using Vector = Eigen::Vector3d;
  using Covariance = Eigen::Matrix<double, 15, 15>;

  struct State {
    Vector position_m = Vector::Zero();
    Vector velocity_m_s = Vector::Zero();
    Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
    Vector acceleration_bias_m_s2 = Vector::Zero();
    Vector rate_bias_rad_s = Vector::Zero();
  };

  explicit BodyFilter(FilterNoise const& noise = {});

  /// At rest: roll and pitch are what makes `acceleration` point up, yaw is zero.
  void level(Vector const& acceleration_m_s2);

  /// By means over `period` of what the inertial unit said.
  void predict(firmware::Time period, Vector const& rate_rad_s, Vector const& acceleration_m_s2);
  /// Without them: the body goes on as it did, and turns as the wheels say.
  void predict_by_wheels(firmware::Time period, double turn_rad_s);

  /// The mean speed of the axle's middle over the period of the last prediction. False when it does not fit what the
  /// inertial unit felt (99.9 %): the wheels slip, and it was not taken.
  [[nodiscard]] bool correct_speed(double speed_m_s);
  /// The same without asking: after a slip that lasts, the wheels know better than what was integrated since.
  void take_speed(double speed_m_s);
  /// Neither wheel moved. `rate_rad_s` is then bias and noise, unless it is more than they can be: false, nothing was
  /// taken.
  [[nodiscard]] bool correct_standing(Vector const& rate_rad_s);

  [[nodiscard]] State const& state() const { return state_; }
  [[nodiscard]] Covariance const& covariance() const { return covariance_; }
  [[nodiscard]] double yaw_rad() const;

 private:
  struct Observation {
    Vector residual;
    Eigen::Matrix<double, 3, 15> jacobian;
    Vector variance;
  };
  [[nodiscard]] Observation speed_observation(double speed_m_s) const;
  [[nodiscard]] static double distance2(Observation const& observation, Covariance const& covariance);
  void correct(Observation const& observation);
  void inject(Eigen::Matrix<double, 15, 1> const& error);

  FilterNoise noise_;
  State state_;
  Covariance covariance_ = Covariance::Zero();
  // Of the last prediction: the mean speed lies half a period back.
  double period_s_ = 0;
  Vector turn_rad_s_ = Vector::Zero();
  Vector acceleration_m_s2_ = Vector::Zero();
  bool has_acceleration_ = false;
};

}  // namespace lapwing::robot
