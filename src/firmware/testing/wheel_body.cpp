#include "firmware/testing/wheel_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::firmware::testing {

namespace {

float constexpr motor_lag_s = 0.12F;
float constexpr standing_m_s = 0.002F;

}  // namespace

float WheelBody::motor(float speed_m_s, float output, float gain, float period_s) const {
  float const moving = std::max(0.0F, std::abs(output) - faults.friction) / (1 - faults.friction);
  float const target = std::copysign(moving, output) * gain * tuning_.full_voltage_speed_m_s;
  float const next = speed_m_s + (target - speed_m_s) * period_s / motor_lag_s;
  // Friction holds what is slow and not driven.
  return target == 0 && std::abs(next) < standing_m_s ? 0.0F : next;
}

void WheelBody::advance(Time period) {
  now_ += period;
  float const period_s = to_seconds(period);
  left_m_s_ = motor(left_m_s_, left_output_, faults.motor_gain * faults.left_motor, period_s);
  right_m_s_ = faults.is_right_blocked ? 0 : motor(right_m_s_, right_output_, faults.motor_gain, period_s);
  left_way_m_ += static_cast<double>(left_m_s_ * period_s);
  right_way_m_ += static_cast<double>(right_m_s_ * period_s);
  float const left_floor = left_m_s_ * (1 - faults.left_slip);
  turn_rad_s_ = (right_m_s_ - left_floor) / description_.wheel_base_m;
  double const speed = static_cast<double>((left_floor + right_m_s_) / 2);
  double const seconds = static_cast<double>(period_s);
  double const middle = heading_rad_ + static_cast<double>(turn_rad_s_) * seconds / 2;
  x_m_ += speed * seconds * std::cos(middle);
  y_m_ += speed * seconds * std::sin(middle);
  heading_rad_ += static_cast<double>(turn_rad_s_) * seconds;
  has_sample_ = true;
}

Pulses WheelBody::pulses() {
  auto const of = [&](double way_m) {
    return static_cast<std::int32_t>(std::floor(way_m * static_cast<double>(description_.pulses_per_m)));
  };
  return {.left = faults.is_left_dead ? 0 : of(left_way_m_), .right = of(right_way_m_)};
}

std::optional<ImuSample> WheelBody::imu() {
  if (faults.is_imu_silent || !std::exchange(has_sample_, false)) return std::nullopt;
  // A yaw of its own: what counts is the change since the start.
  double const half = (heading_rad_ + 2.0) / 2;
  return ImuSample{
      .orientation = {.w = static_cast<float>(std::cos(half)), .x = 0, .y = 0, .z = static_cast<float>(std::sin(half))},
      .rate_rad_s = {.x = 0, .y = 0, .z = turn_rad_s_},
      .acceleration_m_s2 = {.x = 0, .y = 0, .z = 9.807F}};
}

std::uint16_t WheelBody::echo_of_wall(SonarPlace const& sonar) {
  if (!wall_x_m) return no_echo_us;
  float const angle = heading_rad() + sonar.angle_rad;
  float const x = x_m() + sonar.x_m * std::cos(heading_rad()) - sonar.y_m * std::sin(heading_rad());
  float const range = (*wall_x_m - x) / std::cos(angle);
  // A linear congruence (Numerical Recipes): every run makes the same noise.
  noise_ = noise_ * 1'664'525U + 1'013'904'223U;
  float const noise = echo_noise_m * (static_cast<float>(noise_ >> 8U) / 8'388'608.0F - 1);
  float const heard = std::max(0.001F, range + noise);
  return std::cos(angle) < 0.5F || range <= 0 || heard > sonar.longest_m
             ? no_echo_us
             : static_cast<std::uint16_t>(heard * echo_us_per_m);
}

std::span<std::uint16_t const> WheelBody::echoes_us() {
  if (echoes) return *echoes;
  heard_.clear();
  for (auto const& sonar : description_.sonar_places()) heard_.push_back(echo_of_wall(sonar));
  return heard_;
}

std::optional<LaserScan> WheelBody::laser() {
  if (!scan_mm) return std::nullopt;
  seen_ = *std::exchange(scan_mm, std::nullopt);
  return LaserScan{.time = now_, .ranges_mm = seen_};
}

void WheelBody::drive_wheels(float left, float right) {
  left_output_ = left;
  right_output_ = right;
}

std::size_t WheelBody::receive(std::span<std::uint8_t> into) {
  auto const count = std::min(into.size(), to_board.size());
  std::copy_n(to_board.begin(), count, into.begin());
  to_board.erase(to_board.begin(), to_board.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

bool WheelBody::send(std::span<std::uint8_t const> frame) {
  if (is_line_full) return false;
  from_board.insert(from_board.end(), frame.begin(), frame.end());
  return true;
}

}  // namespace lapwing::firmware::testing
