#pragma once

#include "fleet/vehicle_actions.hpp"
#include "vehicle/control.hpp"

namespace lapwing::fleet {

/// Carries out what an operator commands, until it shows in the vehicle's state. Errors: invalid_input (the vehicle
/// cannot do that), refused (with the vehicle's own reason), timed_out, those of Connection::send.
base::Task<base::Result<>> carry_out(mavlink::Connection& connection, Craft& craft, vehicle::VehicleCommand command,
                                     ActionOptions how);

/// One try of an emergency stop, until it shows in the vehicle's state; the errors are the same. A vehicle that is
/// disarmed is disarmed again: an arming may be on its way to it.
base::Task<base::Result<>> stop_at_once(mavlink::Connection& connection, Craft& craft, vehicle::StopAction action,
                                        std::function<void()> on_accepted);

/// Whether a message makes the vehicle arm or move, or lets it go on. Modes that bring it to rest do not.
[[nodiscard]] bool is_moving(Craft const& craft, mavlink::Message const& message);
/// Whether an emergency stop lets the message through: of commands stops, questions, and what cameras and gimbals do;
/// anything else that does not move the vehicle.
[[nodiscard]] bool passes_stop(Craft const& craft, mavlink::Message const& message);

}  // namespace lapwing::fleet
