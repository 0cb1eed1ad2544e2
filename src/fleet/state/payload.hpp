#pragma once

#include "fleet/state/mavlink_vehicle.hpp"
#include "mavlink/codec/messages.hpp"

namespace lapwing::fleet {

/// Takes one message about what the vehicle carries (components, cameras, gimbals, its list of modes) into its state,
/// whichever of its components sent it. What has to be asked for then waits among its questions. True when somebody
/// who looks at the state can see a difference.
bool take_payload(MavlinkVehicle& craft, std::uint8_t component, mavlink::Message const& message, base::TimePoint now);

/// A heartbeat of something aboard other than the autopilot.
void take_component_heartbeat(MavlinkVehicle& craft, mavlink::Address source, mavlink::Heartbeat const& heartbeat,
                              base::TimePoint now);

/// What only the autopilot can be asked, for cameras and gimbals that are wired to it: when it appears, and again after
/// it restarted.
void ask_for_payload(MavlinkVehicle& craft);

/// The name of the mode by our tables, else by the vehicle's own list, which is asked for when it is needed.
[[nodiscard]] std::string name_of_mode(MavlinkVehicle& craft, mavlink::MavType type, std::uint32_t custom_mode);

}  // namespace lapwing::fleet
