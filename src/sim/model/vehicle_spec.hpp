#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "vehicle/family.hpp"

namespace lapwing::sim {

/// One kind of vehicle to simulate, and how many of it.
struct VehicleGroup {
  vehicle::Family family = vehicle::Family::copter;
  int count = 1;
  double battery_remaining = 1.0;  ///< 0..1 at the start
  vehicle::Autopilot firmware = vehicle::Autopilot::ardupilot;

  friend bool operator==(VehicleGroup const&, VehicleGroup const&) = default;
};

/// Reads "copter:2,rover:1,plane" or "copter:2@80%" (starts with 80 % battery); "px4:2" are copters with PX4,
/// "px4-plane" and "px4-rover" the others, everything else flies ArduPilot. Errors: invalid_input, naming the part
/// that is wrong and what is right. At most 250 vehicles: system ids end there.
[[nodiscard]] base::Result<std::vector<VehicleGroup>> parse_vehicles(std::string_view text);

}  // namespace lapwing::sim
