#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include "base/error.hpp"
#include "station/messages/client_request.hpp"
#include "vehicle/control.hpp"

/// What operators say to vehicles is carried out, and what is told about it, as JSON: the part of protocol 1 that
/// docs/reference/ station-messages.md calls "Commands".
namespace lapwing::station {

/// Does what is asked. Gives the number of a command, 0 for anything else. Without `control` everything is refused.
base::Result<std::uint64_t> obey(vehicle::VehicleControl* control, ControlRequest request, vehicle::Commander by);

[[nodiscard]] std::string commands_message(std::deque<vehicle::CommandRecord> const& commands);
[[nodiscard]] std::string emergency_message(vehicle::EmergencyStop const& emergency);
/// One of the commands alone, as the answer to who gave it.
[[nodiscard]] std::string command_body(vehicle::CommandRecord const& command);

}  // namespace lapwing::station
