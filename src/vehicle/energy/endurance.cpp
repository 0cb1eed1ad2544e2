#include "vehicle/energy/endurance.hpp"

#include <algorithm>

#include "vehicle/vehicle_state.hpp"

namespace lapwing::vehicle {

std::optional<Endurance> endurance(double remaining, Drain drain) {
  constexpr double worst_error = 0.5;
  constexpr double half_percent = 0.005;
  constexpr base::Duration longest = std::chrono::hours(48);
  if (!(drain.per_s > 0.0) || !(drain.error <= worst_error)) return std::nullopt;
  double const left_s = std::clamp(remaining, 0.0, 1.0) / drain.per_s;
  if (!(left_s < base::to_seconds(longest))) return std::nullopt;
  double const error_s = left_s * drain.error + half_percent / drain.per_s;
  return Endurance{base::from_seconds(left_s), base::from_seconds(error_s)};
}

std::optional<Endurance> endurance_in_flight(VehicleState const& state) {
  auto const& battery = state.power.battery.value;
  if (!battery) return std::nullopt;
  bool const is_told = battery->time_left && !battery->time_left_is_estimate;
  if (is_told && state.motion.landed.value == false) return Endurance{*battery->time_left, {}};
  return battery->in_flight;
}

}  // namespace lapwing::vehicle
