#pragma once

#include "base/async/task.hpp"
#include "base/log.hpp"
#include "fleet/plausibility/doubts.hpp"
#include "fleet/plausibility/situation.hpp"
#include "plan/plausibility/settings.hpp"
#include "vehicle/control.hpp"

namespace lapwing::fleet {

/// The rules that a command allows, by name, with reasons. Error: invalid_input.
[[nodiscard]] base::Result<plan::plausibility::Settings> settings_for(vehicle::VehicleCommand const& command,
                                                                      plan::plausibility::Settings const& settings);

/// Whether what an operator commands makes sense for the vehicle as it is. Sends nothing that changes anything; before
/// a start it fetches the mission that the vehicle holds, if that is short. Logs what it warns of. Error: invalid_input
/// with what is wrong; `doubts` know by which rule.
base::Task<base::Result<>> heed_command(MavlinkVehicle& craft, vehicle::VehicleCommand const& command,
                                        plan::plausibility::Settings settings, Neighbours const& neighbours,
                                        Doubts& doubts, base::Logger const& log);

}  // namespace lapwing::fleet
