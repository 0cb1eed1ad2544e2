#pragma once

#include <string>

#include <fmt/format.h>

#include "vehicle/vehicle_id.hpp"

namespace lapwing::vehicle {

/// "conflict: MAVLink and test each have a vehicle 1", for what must not be guessed. `owners`: pointers to what has a
/// name.
template <class Owners>
[[nodiscard]] std::string shared_id(Owners const& owners, VehicleId const& id) {
  std::string names;
  for (auto const* owner : owners) names += (names.empty() ? "" : " and ") + owner->name;
  return fmt::format("conflict: {} each have a vehicle {}", names, id.text);
}

}  // namespace lapwing::vehicle
