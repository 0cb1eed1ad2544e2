#include "sim/body/servo_outputs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace lapwing::sim {

using mavlink::MavResult;
using mavlink::MavSeverity;
using vehicle::Family;

namespace {

/// An ArduPilot in the loop has 32 outputs, of which the first 16 are told of.
constexpr int most_channels = 32;

/// SERVOn_FUNCTION: nothing, or handed through from the receiver. Every other has an owner.
bool is_free(int function) {
  return function == 0 || function == 1 || (function >= 51 && function <= 66);
}

std::uint16_t pulse(double middle_us, double share) {
  return static_cast<std::uint16_t>(std::lround(middle_us + 400.0 * std::clamp(share, -1.0, 1.0)));
}

std::uint16_t throttle_pulse(double share) {
  return static_cast<std::uint16_t>(std::lround(1000.0 + 1000.0 * std::clamp(share, 0.0, 1.0)));
}

/// Four motors in an X: right front, left rear, left front, right rear. About 40 % of the throttle hovers; what turns
/// the vehicle comes on top.
void turn_motors(ServoOutputs::Pulses& pulses, Autopilot const& autopilot) {
  constexpr double idle = 0.1;
  constexpr double hover = 0.4;
  auto const& body = autopilot.body();
  double const level = std::cos(body.attitude.roll_rad) * std::cos(body.attitude.pitch_rad);
  double const weight = std::sqrt(std::max(0.2, (1.0 - body.accel_m_s2.down / 9.80665) / std::max(0.5, level)));
  bool const flies = autopilot.landed_state() != mavlink::MavLandedState::on_ground;
  double const collective = !autopilot.armed() ? 0.0 : flies ? hover * weight : idle;
  double const yaw = flies ? 0.02 * body.yaw_rate_rad_s : 0.0;
  for (std::size_t motor = 0; motor < 4; ++motor) pulses[motor] = throttle_pulse(collective + (motor < 2 ? yaw : -yaw));
}

/// Ailerons, elevator, throttle, rudder.
void move_surfaces(ServoOutputs::Pulses& pulses, Autopilot const& autopilot) {
  auto const& body = autopilot.body();
  double const share = autopilot.armed() ? std::clamp(autopilot.battery().current_a() / 20.0, 0.0, 1.0) : 0.0;
  pulses[0] = pulse(1500.0, body.attitude.roll_rad / 0.8);
  pulses[1] = pulse(1500.0, body.attitude.pitch_rad / 0.5);
  pulses[2] = throttle_pulse(share);
  pulses[3] = pulse(1500.0, 0.2 * body.yaw_rate_rad_s);
}

/// Steering on the first output, throttle on the third, both round their middle.
void turn_wheels(ServoOutputs::Pulses& pulses, Autopilot const& autopilot) {
  auto const& body = autopilot.body();
  pulses[0] = pulse(1500.0, body.yaw_rate_rad_s / autopilot.airframe().max_turn_rate_rad_s);
  pulses[2] = pulse(1500.0, body.ground_speed_m_s() / autopilot.airframe().max_speed_m_s);
}

}  // namespace

std::optional<MavResult> ServoOutputs::perform(mavlink::MavCmd command, std::array<float, 4> const& params) {
  auto const whole = [&](std::size_t index) {
    return std::isfinite(params[index]) ? static_cast<int>(std::clamp(params[index], -1.0F, 65535.0F)) : -1;
  };
  if (command == mavlink::MavCmd::do_set_servo) return set_servo(whole(0), whole(1));
  if (command == mavlink::MavCmd::do_set_relay) return set_relay(whole(0), whole(1));
  return std::nullopt;
}

MavResult ServoOutputs::set_servo(int channel, int pulse_us) {
  if (channel < 1 || channel > most_channels) return MavResult::failed;
  if (!is_free(static_cast<int>(parameters_.value(fmt::format("SERVO{}_FUNCTION", channel))))) {
    say_(MavSeverity::info, fmt::format("ServoRelayEvent: Channel {} is already in use", channel));
    return MavResult::failed;
  }
  auto const index = static_cast<std::size_t>(channel) - 1;
  commanded_[index] = static_cast<std::uint16_t>(std::max(pulse_us, 0));
  return MavResult::accepted;
}

/// There is the first relay; 0 off, 1 on, anything else the other way.
MavResult ServoOutputs::set_relay(int number, int state) {
  if (number != 0) return MavResult::failed;
  relay_is_on_ = state == 1 || (state != 0 && !relay_is_on_);
  return MavResult::accepted;
}

ServoOutputs::Pulses ServoOutputs::pulses(Autopilot const& autopilot) const {
  Pulses pulses{};
  auto const family = autopilot.airframe().family;
  if (family == Family::copter || family == Family::sub) turn_motors(pulses, autopilot);
  if (family == Family::plane) move_surfaces(pulses, autopilot);
  if (family == Family::rover) turn_wheels(pulses, autopilot);
  for (auto const& [index, pulse_us] : commanded_)
    if (index < count) pulses[index] = pulse_us;
  return pulses;
}

}  // namespace lapwing::sim
