#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "firmware/board.hpp"
#include "firmware/carrier/tuning.hpp"

namespace lapwing::firmware::testing {

/// A body on a level floor, as the tests of the program need it: two motors with lag, wheels that may slip, encoders
/// that may be dead, an inertial unit, and one wall across the way.
class WheelBody final : public Board {
 public:
  struct Faults {
    float motor_gain = 1.0F;    ///< of both, against what the tuning believes
    float left_motor = 1.0F;    ///< of one against the other
    float left_slip = 0.0F;     ///< part of the wheel's way that is none of the floor's
    bool is_left_dead = false;  ///< the encoder gives no pulses
    bool is_right_blocked = false;
    bool is_imu_silent = false;
    float friction = 0.05F;  ///< part of the voltage that moves nothing
  };

  WheelBody(Description description, Tuning tuning) : description_(description), tuning_(tuning) {}

  void advance(Time period);

  Faults faults;
  /// The wall's x on the floor; the body starts at its origin, facing along x.
  std::optional<float> wall_x_m;
  /// Instead of what the sonars would hear.
  std::optional<std::vector<std::uint16_t>> echoes;
  std::optional<std::vector<std::uint16_t>> scan_mm;  ///< one new scan
  Battery battery_state{.mv = 12'000, .percent = 90};
  bool is_line_full = false;
  float echo_noise_m = 0;

  [[nodiscard]] float x_m() const { return static_cast<float>(x_m_); }
  [[nodiscard]] float y_m() const { return static_cast<float>(y_m_); }
  [[nodiscard]] float heading_rad() const { return static_cast<float>(heading_rad_); }
  [[nodiscard]] float speed_m_s() const { return (left_m_s_ * (1 - faults.left_slip) + right_m_s_) / 2; }
  [[nodiscard]] bool is_standing() const { return left_m_s_ == 0 && right_m_s_ == 0; }
  [[nodiscard]] float clearance_m() const { return *wall_x_m - x_m() - description_.hull.front_m; }
  [[nodiscard]] float left_output() const { return left_output_; }
  [[nodiscard]] float right_output() const { return right_output_; }

  std::deque<std::uint8_t> to_board;
  std::vector<std::uint8_t> from_board;

  [[nodiscard]] Pulses pulses() override;
  [[nodiscard]] std::optional<ImuSample> imu() override;
  [[nodiscard]] std::span<std::uint16_t const> echoes_us() override;
  [[nodiscard]] std::optional<LaserScan> laser() override;
  [[nodiscard]] Battery battery() override { return battery_state; }
  void drive_wheels(float left, float right) override;
  [[nodiscard]] std::size_t receive(std::span<std::uint8_t> into) override;
  bool send(std::span<std::uint8_t const> frame) override;

 private:
  [[nodiscard]] float motor(float speed_m_s, float output, float gain, float period_s) const;
  [[nodiscard]] std::uint16_t echo_of_wall(SonarPlace const& sonar);

  Description description_;
  Tuning tuning_;
  Time now_{};
  float left_output_ = 0;
  float right_output_ = 0;
  float left_m_s_ = 0;
  float right_m_s_ = 0;
  double left_way_m_ = 0;
  double right_way_m_ = 0;
  double x_m_ = 0;
  double y_m_ = 0;
  double heading_rad_ = 0;
  float turn_rad_s_ = 0;
  std::uint32_t noise_ = 1;
  bool has_sample_ = false;
  std::vector<std::uint16_t> heard_;
  std::vector<std::uint16_t> seen_;
};

}  // namespace lapwing::firmware::testing
