#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "fleet/state/mavlink_vehicle.hpp"
#include "plan/plausibility/situation.hpp"

namespace lapwing::fleet {

/// What the other vehicles of the fleet mean to one of them on the ground.
using Neighbours = std::function<std::vector<plan::plausibility::Neighbour>(MavlinkVehicle const&)>;

/// Whether it tells where it is, and its estimator stands by that.
[[nodiscard]] bool knows_its_place(MavlinkVehicle const& craft);

/// Whether it stands on the ground, so far as it has told.
[[nodiscard]] std::optional<bool> stands_on_ground(MavlinkVehicle const& craft);

/// What is known of the vehicle now. A place that it does not know counts as none.
[[nodiscard]] plan::plausibility::Situation situation_of(MavlinkVehicle const& craft, Neighbours const& neighbours);

}  // namespace lapwing::fleet
