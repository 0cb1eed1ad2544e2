#pragma once

#include <optional>
#include <vector>

#include "base/time.hpp"
#include "vehicle/aged.hpp"
#include "vehicle/energy/endurance.hpp"

namespace lapwing::vehicle {

/// What a battery's own monitor, and the failsafes set in the vehicle, make of its charge.
enum class Charge { unknown, ok, low, critical };

struct Battery {
  double remaining = 0.0;  ///< 0..1
  std::optional<double> voltage_v;
  std::optional<double> current_a;
  int id = 0;
  std::optional<double> consumed_ah = {};
  std::optional<base::Duration> time_left = {};  ///< at what the vehicle does now
  base::Duration time_left_error = {};           ///< to either side; of an estimate only
  bool time_left_is_estimate = false;            ///< ours, not the vehicle's: from what it draws
  /// What is left would last so long in flight, by this flight or the last one; nothing before it has flown.
  std::optional<Endurance> in_flight = {};
  Charge charge = Charge::unknown;
};

/// What it runs on.
struct Power {
  Aged<Battery> battery;                         ///< the first one, by which guards go
  std::vector<Aged<Battery>> further_batteries;  ///< by id
};

}  // namespace lapwing::vehicle
