#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

/// Whether a vehicle says in this status text that it begins to act by itself: a failsafe, a breach, a low battery. Not
/// when it says that one is over, was set up, or stands against arming.
[[nodiscard]] bool tells_failsafe(std::string_view text);

/// Why the vehicle may have changed its mode by itself just now, in its own words; what FENCE_STATUS tells where it has
/// none (ArduRover). `fence_breached`: when the last new breach was heard of. Empty when it told of nothing.
[[nodiscard]] std::string recent_failsafe(vehicle::VehicleState const& state, base::TimePoint now,
                                          std::optional<base::TimePoint> fence_breached = std::nullopt);

}  // namespace lapwing::fleet
