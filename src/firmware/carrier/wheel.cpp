#include "firmware/carrier/wheel.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::firmware {

namespace {

/// Below this a wheel that is to stand does, since the speed that is measured is that of a twentieth of a second ago.
float constexpr standing_m_s = 0.02F;
/// No geared motor turns as slowly as this: it sticks, and then it jerks.
float constexpr slowest_m_s = 0.002F;

}  // namespace

void Wheel::feel(Time now, std::int32_t pulses) {
  // Unsigned, so that the counter may wrap.
  auto const step =
      static_cast<std::int32_t>(static_cast<std::uint32_t>(pulses) - static_cast<std::uint32_t>(last_pulses_));
  last_pulses_ = pulses;
  if (count_ > 0) way_pulses_ += step;
  Sample const newest{.time = now, .pulses = way_pulses_};
  Time const period = count_ > 0 ? now - samples_[(count_ - 1) % window].time : Time{0};
  samples_[count_ % window] = newest;
  ++count_;
  // The ring counts on for ever; it need only be known that it is full.
  if (count_ == 2 * window) count_ = window;
  auto const& oldest = samples_[count_ < window ? 0 : count_ % window];
  float const span_s = to_seconds(newest.time - oldest.time);
  speed_m_s_ = span_s > 0 ? static_cast<float>(newest.pulses - oldest.pulses) / pulses_per_m_ / span_s : 0.0F;
  watch(period, step != 0);
}

void Wheel::watch(Time period, bool has_moved) {
  bool const is_driven = std::abs(output_) >= tuning_.dead_wheel_output;
  unmoved_ = is_driven && !has_moved ? unmoved_ + period : Time{0};
  if (unmoved_ >= tuning_.dead_wheel_after) is_dead_ = true;
}

float Wheel::drive(Time now, float target_m_s) {
  bool const is_to_stand = std::abs(target_m_s) < slowest_m_s;
  if (is_to_stand && std::abs(speed_m_s_) < standing_m_s) {
    rest();
    return output_;
  }
  float const period_s = is_driven_ ? to_seconds(now - last_drive_) : 0.0F;
  last_drive_ = now;
  is_driven_ = true;
  // What the integral learnt of driving would push a wheel that is to stand beyond its standing.
  if (is_to_stand) integral_m_s_ = 0;
  float const error = target_m_s - speed_m_s_;
  float const learnt = is_to_stand ? 0.0F : tuning_.speed_integral_per_s * error * period_s;
  float const integral = integral_m_s_ + learnt;
  float const wanted = (target_m_s + tuning_.speed_gain * error + integral) / tuning_.full_voltage_speed_m_s;
  output_ = std::clamp(wanted, -1.0F, 1.0F);
  if (wanted == output_ || std::abs(integral) < std::abs(integral_m_s_)) integral_m_s_ = integral;
  return output_;
}

void Wheel::rest() {
  output_ = 0;
  integral_m_s_ = 0;
  is_driven_ = false;
}

}  // namespace lapwing::firmware
