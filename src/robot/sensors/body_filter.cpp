#include "robot/sensors/body_filter.hpp"

#include <cmath>

#include <Eigen/LU>

namespace lapwing::robot {

namespace {

using Vector = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

double constexpr gravity_m_s2 = 9.80665;
/// 99.9 % of what noise makes lies below: chi-squared with one degree of freedom, and with three.
double constexpr plausible_of_one = 10.83;
double constexpr plausible_of_three = 16.27;
/// Without an accelerometer the speed may change as fast as the motors can make it.
double constexpr unfelt_acceleration_m_s2 = 0.5;

// Where each part of the error state begins.
int constexpr at_position = 0;
int constexpr at_velocity = 3;
int constexpr at_turn = 6;
int constexpr at_acceleration_bias = 9;
int constexpr at_rate_bias = 12;

Vector gravity() {
  return {0, 0, -gravity_m_s2};
}

/// [v]×: cross product as a matrix.
Matrix3 skew(Vector const& v) {
  Matrix3 matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

/// The turn by a rotation vector (Exp, in the paper).
Eigen::Quaterniond rotation(Vector const& turn_rad) {
  double const angle = turn_rad.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn_rad / angle));
}

double squared(double value) {
  return value * value;
}

}  // namespace

BodyFilter::BodyFilter(FilterNoise const& noise) : noise_(noise) {
  auto const set = [&](int at, Vector const& deviation) {
    covariance_.diagonal().segment<3>(at) = deviation.cwiseProduct(deviation);
  };
  // Where it begins is what position and yaw are told from: both are known.
  set(at_turn, {noise_.first_tilt_rad, noise_.first_tilt_rad, 0});
  set(at_acceleration_bias, Vector::Constant(noise_.first_acceleration_bias_m_s2));
  set(at_rate_bias, Vector::Constant(noise_.first_rate_bias_rad_s));
}

void BodyFilter::level(Vector const& acceleration_m_s2) {
  // The shortest turn onto the vertical leaves a little yaw where both angles are large; taken out so that it is zero.
  auto const upright = Eigen::Quaterniond::FromTwoVectors(acceleration_m_s2, Vector::UnitZ());
  Matrix3 const r = upright.toRotationMatrix();
  double const yaw = std::atan2(r(1, 0), r(0, 0));
  state_.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(-yaw, Vector::UnitZ())) * upright;
}

void BodyFilter::predict(firmware::Time period, Vector const& rate_rad_s, Vector const& acceleration_m_s2) {
  double const dt = std::chrono::duration<double>(period).count();
  Vector const force = acceleration_m_s2 - state_.acceleration_bias_m_s2;
  Vector const turn = rate_rad_s - state_.rate_bias_rad_s;
  // The force was felt on average half a period ago, turned half as far.
  Matrix3 const r = (state_.orientation * rotation(turn * dt / 2)).toRotationMatrix();
  Vector const acceleration = r * force + gravity();

  // Nominal state (5.4.1).
  state_.position_m += state_.velocity_m_s * dt + acceleration * dt * dt / 2;
  state_.velocity_m_s += acceleration * dt;
  state_.orientation = (state_.orientation * rotation(turn * dt)).normalized();

  // Error state (5.4.2, 5.4.3): F_x P F_xᵀ + F_i Q_i F_iᵀ.
  Covariance f = Covariance::Identity();
  f.block<3, 3>(at_position, at_velocity) = Matrix3::Identity() * dt;
  f.block<3, 3>(at_velocity, at_turn) = -r * skew(force) * dt;
  f.block<3, 3>(at_velocity, at_acceleration_bias) = -r * dt;
  f.block<3, 3>(at_turn, at_turn) = rotation(turn * dt).toRotationMatrix().transpose();
  f.block<3, 3>(at_turn, at_rate_bias) = -Matrix3::Identity() * dt;
  covariance_ = f * covariance_ * f.transpose();
  covariance_.diagonal().segment<3>(at_velocity).array() += squared(noise_.acceleration_m_s2 * dt);
  covariance_.diagonal().segment<3>(at_turn).array() += squared(noise_.rate_rad_s * dt);
  covariance_.diagonal().segment<3>(at_acceleration_bias).array() += squared(noise_.acceleration_bias_walk) * dt;
  covariance_.diagonal().segment<3>(at_rate_bias).array() += squared(noise_.rate_bias_walk) * dt;

  period_s_ = dt;
  turn_rad_s_ = turn;
  acceleration_m_s2_ = acceleration_m_s2;
  has_acceleration_ = true;
}

void BodyFilter::predict_by_wheels(firmware::Time period, double turn_rad_s) {
  double const dt = std::chrono::duration<double>(period).count();
  Vector const turn = Vector::UnitZ() * turn_rad_s;
  state_.position_m += state_.velocity_m_s * dt;
  auto const change = rotation(turn * dt);
  // A body with wheels goes where it faces: its velocity turns with it.
  state_.velocity_m_s = state_.orientation * (change * (state_.orientation.inverse() * state_.velocity_m_s));
  state_.orientation = (state_.orientation * change).normalized();

  Covariance f = Covariance::Identity();
  f.block<3, 3>(at_position, at_velocity) = Matrix3::Identity() * dt;
  f.block<3, 3>(at_turn, at_turn) = change.toRotationMatrix().transpose();
  covariance_ = f * covariance_ * f.transpose();
  covariance_.diagonal().segment<3>(at_velocity).array() += squared(unfelt_acceleration_m_s2 * dt);
  covariance_.diagonal().segment<3>(at_turn).array() += squared(noise_.wheel_turn_rad_s * dt);
  covariance_.diagonal().segment<3>(at_rate_bias).array() += squared(noise_.rate_bias_walk) * dt;

  period_s_ = dt;
  turn_rad_s_ = turn;
  has_acceleration_ = false;
}

/// z = (speed, 0, 0) in the body as it was in the middle of the period, turned into the body as it is now.
/// h = Rᵀ(v - a Δt/2), the mean velocity in the body; with the acceleration felt, a = R(a_m - a_b) + g, it is
/// Rᵀv - (a_m - a_b) Δt/2 - Rᵀg Δt/2. By δθ, R becomes R(I + [δθ]×), so that Rᵀu changes by [Rᵀu]× δθ.
BodyFilter::Observation BodyFilter::speed_observation(double speed_m_s) const {
  Matrix3 const world_to_body = state_.orientation.toRotationMatrix().transpose();
  Vector const measured = rotation(turn_rad_s_ * period_s_ / 2).inverse() * Vector(speed_m_s, 0, 0);
  double const half = period_s_ / 2;
  Observation observation;
  observation.jacobian.setZero();
  observation.jacobian.block<3, 3>(0, at_velocity) = world_to_body;
  Vector expected = world_to_body * state_.velocity_m_s;
  if (has_acceleration_) {
    expected -= half * (acceleration_m_s2_ - state_.acceleration_bias_m_s2 + world_to_body * gravity());
    observation.jacobian.block<3, 3>(0, at_acceleration_bias) = Matrix3::Identity() * half;
    observation.jacobian.block<3, 3>(0, at_turn) = skew(world_to_body * (state_.velocity_m_s - half * gravity()));
  } else {
    observation.jacobian.block<3, 3>(0, at_turn) = skew(expected);
  }
  observation.residual = measured - expected;
  double const along = noise_.wheel_speed_m_s + noise_.wheel_speed_part * std::abs(speed_m_s);
  observation.variance = {squared(along), squared(noise_.sideways_m_s), squared(noise_.sideways_m_s)};
  return observation;
}

bool BodyFilter::correct_speed(double speed_m_s) {
  auto const observation = speed_observation(speed_m_s);
  // Along the way only: what is sideways is no wheel's word.
  Eigen::Matrix<double, 1, 15> const h = observation.jacobian.row(0);
  double const variance = (h * covariance_ * h.transpose())(0, 0) + observation.variance.x();
  if (squared(observation.residual.x()) > plausible_of_one * variance) return false;
  correct(observation);
  return true;
}

void BodyFilter::take_speed(double speed_m_s) {
  // What was integrated meanwhile is worth nothing: the velocity is as unknown as at first.
  covariance_.diagonal().segment<3>(at_velocity).array() += 1.0;
  correct(speed_observation(speed_m_s));
}

bool BodyFilter::correct_standing(Vector const& rate_rad_s) {
  Observation bias;
  bias.jacobian.setZero();
  bias.jacobian.block<3, 3>(0, at_rate_bias) = Matrix3::Identity();
  bias.residual = rate_rad_s - state_.rate_bias_rad_s;
  bias.variance = Vector::Constant(squared(noise_.rate_rad_s));
  if (distance2(bias, covariance_) > plausible_of_three) return false;
  correct(bias);

  Observation still;
  still.jacobian.setZero();
  still.jacobian.block<3, 3>(0, at_velocity) = Matrix3::Identity();
  still.residual = -state_.velocity_m_s;
  still.variance = Vector::Constant(squared(noise_.standing_m_s));
  correct(still);
  return true;
}

double BodyFilter::distance2(Observation const& observation, Covariance const& covariance) {
  auto const& h = observation.jacobian;
  Matrix3 innovation = h * covariance * h.transpose();
  innovation.diagonal() += observation.variance;
  return observation.residual.dot(innovation.inverse() * observation.residual);
}

/// K = P Hᵀ (H P Hᵀ + V)⁻¹ and the covariance in Joseph's form, which stays positive whatever is rounded (6.1) and is
/// right for any gain: for that of the considered states, too, which is zero.
void BodyFilter::correct(Observation const& observation) {
  auto const& h = observation.jacobian;
  Matrix3 const noise = observation.variance.asDiagonal();
  Matrix3 const innovation = h * covariance_ * h.transpose() + noise;
  Eigen::Matrix<double, 15, 3> gain = covariance_ * h.transpose() * innovation.inverse();
  Vector const up = state_.orientation.inverse() * Vector::UnitZ();
  gain.middleRows<3>(at_position).setZero();
  gain.middleRows<3>(at_turn) -= (up * (up.transpose() * gain.middleRows<3>(at_turn))).eval();
  Covariance const rest = Covariance::Identity() - gain * h;
  covariance_ = rest * covariance_ * rest.transpose() + gain * noise * gain.transpose();
  inject(gain * observation.residual);
}

/// Injection (6.2), and the reset with G = I - [δθ/2]× for the turn (6.3).
void BodyFilter::inject(Eigen::Matrix<double, 15, 1> const& error) {
  Vector const turn = error.segment<3>(at_turn);
  state_.position_m += error.segment<3>(at_position);
  state_.velocity_m_s += error.segment<3>(at_velocity);
  state_.orientation = (state_.orientation * rotation(turn)).normalized();
  state_.acceleration_bias_m_s2 += error.segment<3>(at_acceleration_bias);
  state_.rate_bias_rad_s += error.segment<3>(at_rate_bias);
  Covariance g = Covariance::Identity();
  g.block<3, 3>(at_turn, at_turn) -= skew(turn / 2);
  covariance_ = g * covariance_ * g.transpose();
}

double BodyFilter::yaw_rad() const {
  Matrix3 const r = state_.orientation.toRotationMatrix();
  return std::atan2(r(1, 0), r(0, 0));
}

}  // namespace lapwing::robot
