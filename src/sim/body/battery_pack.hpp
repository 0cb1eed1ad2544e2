#pragma once

#include "base/assert.hpp"
#include "sim/body/dynamics.hpp"

namespace lapwing::sim {

/// A three-cell lithium pack drained by what the vehicle does.
class BatteryPack {
 public:
  /// Precondition: capacity_mah > 0, 0 <= remaining <= 1.
  explicit BatteryPack(double capacity_mah, double remaining = 1.0)
      : capacity_mah_(capacity_mah), used_mah_(capacity_mah * (1.0 - remaining)) {
    LAPWING_ASSERT(capacity_mah > 0.0 && remaining >= 0.0 && remaining <= 1.0, capacity_mah, remaining);
  }

  /// Draws `current_a` for `dt_s`.
  void drain(double current_a, double dt_s);
  /// Sets the charge left, 0..1: a test's or an operator's hand.
  void set_remaining(double remaining) { used_mah_ = capacity_mah_ * (1.0 - remaining); }

  [[nodiscard]] double capacity_mah() const { return capacity_mah_; }
  [[nodiscard]] double used_mah() const { return used_mah_; }
  [[nodiscard]] double current_a() const { return current_a_; }
  /// 0..1, from the charge drawn as ArduPilot counts it.
  [[nodiscard]] double remaining() const;
  /// Terminal voltage: open circuit by charge, less the drop over the inner resistance.
  [[nodiscard]] double voltage_v() const;

 private:
  double capacity_mah_;
  double used_mah_;
  double current_a_ = 0.0;
};

/// Current in A that a vehicle draws from its pack: avionics, and when `motors_run` hover, climb and speed power.
[[nodiscard]] double current_drawn_a(Body const& body, Airframe const& airframe, bool motors_run);

}  // namespace lapwing::sim
