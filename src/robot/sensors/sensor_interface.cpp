#include "robot/sensors/sensor_interface.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::robot {

namespace {

/// Two readings without a pulse: after the first the body may still be rolling out.
int constexpr readings_of_standing = 2;
/// Wheels that disagree for longer have not slipped for a moment: then they are believed again.
int constexpr most_slipping_readings = 5;

BodyFilter::Vector vector_of(firmware::Vector3 const& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

Attitude attitude_of(Eigen::Quaterniond const& q) {
  return attitude({.w = static_cast<float>(q.w()),
                   .x = static_cast<float>(q.x()),
                   .y = static_cast<float>(q.y()),
                   .z = static_cast<float>(q.z())});
}

/// x, y and yaw of the filter's covariance. On a floor the error about the body's z axis is that of the yaw.
Eigen::Matrix3d planar(BodyFilter::Covariance const& all) {
  Eigen::Vector3i const at(0, 1, 8);
  Eigen::Matrix3d planar;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) planar(row, column) = all(at(row), at(column));
  return planar;
}

}  // namespace

bool Sensed::Faults::any() const {
  bool const has_sonar = std::ranges::any_of(sonars, [](SensorFault fault) { return fault != SensorFault::none; });
  return has_sonar || imu != SensorFault::none || encoders != SensorFault::none || is_slipping;
}

SensorInterface::SensorInterface(firmware::Description const& description, FilterNoise const& noise)
    : body_(description), odometer_(description), filter_(noise) {
  for (auto const& place : description.sonar_places()) sonar_watches_.emplace_back(place);
}

std::optional<Sensed> SensorInterface::feed(firmware::Readings const& readings) {
  auto const step = odometer_.feed(readings);
  if (!step) return std::nullopt;
  Sensed sensed;
  sensed.time = readings.time;
  sensed.period = step->wheels.period;
  sensed.wheels = step->wheels;
  sensed.faults.imu = imu_watch_.feed(readings);
  sensed.faults.encoders = look_at_wheels(readings, step->has_jumped);
  move(readings, step->wheels, sensed);
  moved_.way_m += std::abs(step->wheels.way_m());
  moved_.turn_rad += std::abs(sensed.turn_rad_s) * step->wheels.seconds();
  sensed.way_m = moved_.way_m;
  listen(readings, sensed);
  return sensed;
}

SensorFault SensorInterface::look_at_wheels(firmware::Readings const& readings, bool has_jumped) {
  if (readings.has(firmware::Flag::left_wheel_dead) || readings.has(firmware::Flag::right_wheel_dead))
    return SensorFault::stuck;
  return has_jumped ? SensorFault::jumping : SensorFault::none;
}

void SensorInterface::move(firmware::Readings const& readings, WheelStep const& wheels, Sensed& sensed) {
  bool const is_felt = readings.imu && sensed.faults.imu == SensorFault::none;
  auto const rate = is_felt ? vector_of(readings.imu->rate_rad_s) : BodyFilter::Vector(0, 0, wheels.turn_rad_s());
  if (is_felt) {
    auto const force = vector_of(readings.imu->acceleration_m_s2);
    if (!is_level_) filter_.level(force);
    is_level_ = true;
    filter_.predict(wheels.period, rate, force);
  } else {
    filter_.predict_by_wheels(wheels.period, wheels.turn_rad_s());
  }
  standing_ = wheels.is_standing() ? standing_ + 1 : 0;
  bool const is_wheel_word_good = sensed.faults.encoders == SensorFault::none;
  bool const is_standing = is_felt && standing_ >= readings_of_standing && is_wheel_word_good;
  bool is_taken = is_standing && filter_.correct_standing(rate);
  if (!is_taken && is_wheel_word_good) is_taken = filter_.correct_speed(wheels.speed_m_s());
  slipping_ = is_taken || !is_wheel_word_good ? 0 : slipping_ + 1;
  if (slipping_ > most_slipping_readings) filter_.take_speed(wheels.speed_m_s());
  sensed.faults.is_slipping = slipping_ > 0 || readings.has(firmware::Flag::slipping);

  auto const& state = filter_.state();
  sensed.attitude = attitude_of(state.orientation);
  sensed.attitude.yaw_rad = filter_.yaw_rad();
  sensed.pose = {.position = {state.position_m.x(), state.position_m.y()}, .yaw_rad = filter_.yaw_rad()};
  sensed.covariance = planar(filter_.covariance());
  sensed.speed_m_s = (state.orientation.inverse() * state.velocity_m_s).x();
  sensed.turn_rad_s = is_felt ? rate.z() - state.rate_bias_rad_s.z() : wheels.turn_rad_s();
}

void SensorInterface::listen(firmware::Readings const& readings, Sensed& sensed) {
  auto const echoes = readings.echoes();
  auto const places = body_.sonar_places();
  for (std::size_t i = 0; i < places.size(); ++i) {
    // A sonar that the readings do not have at all is one without an echo.
    auto const echo = i < echoes.size() ? echoes[i] : firmware::no_echo_us;
    auto const fault = sonar_watches_[i].feed(echo, moved_);
    sensed.faults.sonars.push_back(fault);
    sensed.sonars.push_back(
        {.place = places[i], .range_m = is_believed(fault) ? range_of_echo(echo, places[i]) : std::nullopt});
  }
  sensed.walls = wall_distances(sensed.sonars, body_.hull);
}

}  // namespace lapwing::robot
