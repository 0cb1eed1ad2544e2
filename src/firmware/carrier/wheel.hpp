#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/board_time.hpp"
#include "firmware/carrier/tuning.hpp"

namespace lapwing::firmware {

/// One wheel: how fast its pulses say it is, and the voltage that makes it as fast as wanted.
///
/// output = (target + P (target - speed) + I) / full speed, with I the integral of the error (held while the output is
/// at its limit, so that a blocked wheel does not race when it comes free).
class Wheel {
 public:
  Wheel(Tuning const& tuning, float pulses_per_m) : tuning_(tuning), pulses_per_m_(pulses_per_m) {}

  /// Call once each control period, before the rest.
  void feel(Time now, std::int32_t pulses);
  /// Mean over the last tenth of a second: a pulse more or less is 10 pulses/s then.
  [[nodiscard]] float speed_m_s() const { return speed_m_s_; }
  /// Since the first `feel`.
  [[nodiscard]] float way_m() const { return static_cast<float>(way_pulses_) / pulses_per_m_; }

  /// The voltage for `target`, as a fraction of the full one.
  [[nodiscard]] float drive(Time now, float target_m_s);
  /// Voltage off, and nothing is remembered of the driving before.
  void rest();
  [[nodiscard]] float output() const { return output_; }
  /// It was driven, and no pulse came.
  [[nodiscard]] bool is_dead() const { return is_dead_; }
  void forgive() {
    is_dead_ = false;
    unmoved_ = Time{0};
  }

 private:
  /// Six samples are five control periods: with 20 ms a tenth of a second.
  static constexpr std::size_t window = 6;
  struct Sample {
    Time time{};
    std::int64_t pulses = 0;
  };
  void watch(Time period, bool has_moved);

  Tuning tuning_;
  float pulses_per_m_;
  std::array<Sample, window> samples_{};
  std::size_t count_ = 0;
  std::int32_t last_pulses_ = 0;
  std::int64_t way_pulses_ = 0;
  float speed_m_s_ = 0;
  float integral_m_s_ = 0;
  float output_ = 0;
  Time last_drive_{};
  Time unmoved_{};
  bool is_driven_ = false;
  bool is_dead_ = false;
};

}  // namespace lapwing::firmware
