#pragma once

#include <compare>
#include <string>

namespace lapwing::vehicle {

/// Names one vehicle of the fleet. For a MAVLink vehicle the decimal system id ("1"); other platforms choose their own
/// ("a1").
struct VehicleId {
  std::string text;

  friend auto operator<=>(VehicleId const&, VehicleId const&) = default;
};

}  // namespace lapwing::vehicle
