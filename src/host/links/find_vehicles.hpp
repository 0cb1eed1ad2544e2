#pragma once

#include <string>
#include <vector>

#include "host/links/ground.hpp"
#include "mavlink/wire/system_name.hpp"

namespace lapwing::host {

/// Waits until the vehicles of these names are heard, or whichever are when none are named; in the order of the names.
/// Vehicles that share a system id are found, too: sending to them is what is refused.
/// Errors: lost (nobody, or not all of them, within `patience`; tells who was heard), invalid_input (no link belongs to
/// a vehicle's network).
base::Task<base::Result<std::vector<fleet::MavlinkVehicle*>>> find_vehicles(Ground& ground,
                                                                            std::vector<mavlink::SystemName> wanted,
                                                                            base::Duration patience);
/// The one that is wanted. Without a name the only one: invalid_input when several are heard.
base::Task<base::Result<fleet::MavlinkVehicle*>> find_vehicle(Ground& ground, std::vector<mavlink::SystemName> wanted,
                                                              base::Duration patience);

/// Of the option --vehicle.
inline constexpr auto vehicle_help = "System id; NETWORK/ID where its link belongs to a network, e.g. north/7";
/// Its values. Error: invalid_input.
[[nodiscard]] base::Result<std::vector<mavlink::SystemName>> parse_vehicles(std::vector<std::string> const& texts);

}  // namespace lapwing::host
