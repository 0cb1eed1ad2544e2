#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/building/noise.hpp"
#include "sim/building/scene/faces.hpp"

namespace lapwing::sim::building {

/// Two driven wheels side by side under a round body; the axle is its middle.
struct DriveSettings {
  double radius_m = 0.18;
  double wheel_base_m = 0.28;
  double full_voltage_speed_m_s = 0.4;
  double lag_s = 0.06;              ///< time constant of a motor with its load
  double most_force_m_s2 = 1.5;     ///< no wheel changes its speed faster than its motor or its grip let it
  double dead_band = 0.03;          ///< part of the full voltage below which friction holds the wheel
  double pulses_per_m = 9'400.0;    ///< of the turning wheel, each edge
  double motor_spread = 0.03;       ///< standard deviation: no two motors are alike
  double wheel_spread = 0.003;      ///< standard deviation of a wheel's size, by which its pulses are off
  double slip_m_per_sqrt_m = 0.01;  ///< standard deviation of what each wheel loses or wins on one metre
  double slip_changes_m = 0.2;      ///< how far it goes until the floor under a wheel is another
};

/// What a body ran into.
struct Contact {
  Thing thing = Thing::wall;
  std::uint32_t number = 0;
  double speed_m_s = 0.0;  ///< into it
  Place at;
};

/// Where a robot is and how it moves: motors that lag, wheels that slip, and walls that it does not pass.
class DrivenBody {
 public:
  DrivenBody(DriveSettings const& settings, Pose const& pose, std::uint64_t seed, std::uint32_t number);

  /// Voltages as parts of the full one. Returns what it touches now and pushes against; `around.posts` may have this
  /// robot's own, told by its number.
  [[nodiscard]] std::vector<Contact> step(double seconds, double left, double right, Surroundings const& around);

  /// Of one wheel, how far the ground goes under it for each metre that it turns: 1 is grip, 0 is ice.
  void set_grip(Side wheel, double grip);
  /// Somebody lifts it and puts it down elsewhere.
  void put(Pose const& pose) { pose_ = pose; }

  [[nodiscard]] Pose const& pose() const { return pose_; }
  [[nodiscard]] double speed_m_s() const { return speed_m_s_; }  ///< over the ground
  [[nodiscard]] double turn_rad_s() const { return turn_rad_s_; }
  [[nodiscard]] double acceleration_m_s2() const { return acceleration_m_s2_; }
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] std::int32_t pulses(Side wheel) const;
  [[nodiscard]] double wheel_speed_m_s(Side wheel) const { return wheels_[index(wheel)].speed_m_s; }

 private:
  struct Wheel {
    double full_speed_m_s = 0.0;
    double pulses_per_m = 0.0;
    double grip = 1.0;
    double slip = 0.0;       ///< part of the way, now
    double speed_m_s = 0.0;  ///< of its rim
    double turned_m = 0.0;   ///< of its rim
  };
  static constexpr std::size_t index(Side side) { return side == Side::left ? 0 : 1; }
  void drive(Wheel& wheel, double voltage, double seconds) const;
  [[nodiscard]] double ground_way_m(Wheel& wheel, double seconds);
  [[nodiscard]] std::vector<Contact> push_out(Surroundings const& around);

  DriveSettings settings_;
  std::uint32_t number_;
  Noise noise_;
  Wheel wheels_[2];
  Pose pose_;
  double speed_m_s_ = 0.0;
  double turn_rad_s_ = 0.0;
  double acceleration_m_s2_ = 0.0;
  double driven_m_ = 0.0;
};

}  // namespace lapwing::sim::building
