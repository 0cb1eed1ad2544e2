#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/text/source.hpp"
#include "dolphin/names/needs.hpp"
#include "host/links/equipment.hpp"
#include "sim/world/world.hpp"

namespace lapwing::host {

/// Simulated vehicles for everything that the script picks: a copter where it wants a UAV or anything, a rover for a
/// UGV, a boat for a USV, a sub for a UUV. Errors: invalid_input when a pick cannot be read or asks for what cannot be
/// simulated.
[[nodiscard]] base::Result<std::vector<sim::VehicleGroup>> simulated_fleet_for(dolphin::Needs const& needs,
                                                                               base::SourceFile const& source);
/// The equipment that any of the picks asks for, each once.
[[nodiscard]] std::vector<std::string> payload_for(dolphin::Needs const& needs);
/// The same equipment for every simulated vehicle.
[[nodiscard]] Equipment equipped(sim::WorldOptions const& world, std::vector<std::string> const& payload);
/// What a script needs, as far as its text says it; a text that cannot be read needs nothing.
[[nodiscard]] dolphin::Needs needs_of_text(std::string const& name, std::string const& text);
/// "copter:2,rover:1"
[[nodiscard]] std::string to_text(std::vector<sim::VehicleGroup> const& groups);

}  // namespace lapwing::host
