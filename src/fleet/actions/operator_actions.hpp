#pragma once

#include "fleet/actions/vehicle_actions.hpp"
#include "vehicle/control.hpp"

namespace lapwing::fleet {

/// The mode in which a vehicle takes off by itself, to a height of its own setting: planes of ArduPilot, everything of
/// PX4. Nothing for those that are told the height.
[[nodiscard]] std::optional<std::uint32_t> take_off_mode(MavlinkVehicle const& craft);

/// Of a take-off for which nobody said one.
inline constexpr double usual_take_off_height_m = 10.0;

/// Whether the vehicle flies what it holds after the command: a vehicle that stands in its mission mode does so as soon
/// as it is armed, if it has wheels.
[[nodiscard]] bool flies_the_plan(MavlinkVehicle const& craft, vehicle::VehicleCommand const& command);

/// Sends what an operator commands until the vehicle has acknowledged it and shows the mode for it; what it makes of it
/// then is for `Goal` to see. Errors: invalid_input (the vehicle cannot do that), refused (with the vehicle's own
/// reason), timed_out, those of Connection::send.
base::Task<base::Result<>> carry_out(mavlink::Connection& connection, MavlinkVehicle& craft,
                                     vehicle::VehicleCommand command, ActionOptions how);

/// One try of an emergency stop, until it shows in the vehicle's state; the errors are the same. A vehicle that is
/// disarmed is disarmed again: an arming may be on its way to it.
base::Task<base::Result<>> stop_at_once(mavlink::Connection& connection, MavlinkVehicle& craft,
                                        vehicle::StopAction action, std::function<void()> on_accepted);

/// Whether a message makes the vehicle arm or move, or lets it go on. Modes that bring it to rest do not.
[[nodiscard]] bool is_moving(MavlinkVehicle const& craft, mavlink::Message const& message);
/// Whether an emergency stop lets the message through: of commands stops, questions, and what cameras and gimbals do;
/// anything else that does not move the vehicle.
[[nodiscard]] bool passes_stop(MavlinkVehicle const& craft, mavlink::Message const& message);

}  // namespace lapwing::fleet
