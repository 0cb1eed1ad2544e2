#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/source.hpp"
#include "dolphin/needs.hpp"
#include "sim/vehicle_spec.hpp"

namespace lapwing::apps {

/// Simulated vehicles for everything that the script picks: a copter where it wants a UAV or anything, a rover for a
/// UGV. Errors: invalid_input when a pick cannot be read or asks for what cannot be simulated.
[[nodiscard]] base::Result<std::vector<sim::VehicleGroup>> crew_for(dolphin::Needs const& needs,
                                                                    base::SourceFile const& source);
/// The equipment that any of the picks asks for, each once.
[[nodiscard]] std::vector<std::string> payload_for(dolphin::Needs const& needs);
/// "copter:2,rover:1"
[[nodiscard]] std::string to_text(std::vector<sim::VehicleGroup> const& groups);

}  // namespace lapwing::apps
