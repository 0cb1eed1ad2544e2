#pragma once

#include <span>

#include "fleet/network/message_rates.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "mavlink/codec/messages.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

/// Takes one message of the vehicle's autopilot (heartbeats excepted: discovery) into its state, each field with the
/// time at which it was heard. What the autopilot marks as unknown, or what cannot be true yet (a position without a
/// fix, a heading before the estimator has settled), leaves the field as it was. True when somebody who looks at the
/// state can see a difference.
bool take_telemetry(MavlinkVehicle& craft, mavlink::Message const& message, base::TimePoint now);

/// Appends texts that are complete now to the state; returns them for the log.
std::vector<vehicle::StatusText> take_text(MavlinkVehicle& craft, std::uint8_t component,
                                           mavlink::StatusText const& chunk, base::TimePoint now);
/// The same for texts whose missing chunks are not coming any more.
std::vector<vehicle::StatusText> take_overdue_texts(MavlinkVehicle& craft, base::TimePoint now);

/// A run is about to begin: what was told of another mission does not count for it.
void begin_trace(MavlinkVehicle& craft);

/// What the telemetry radio on the vehicle's link says of itself.
void take_radio(MavlinkVehicle& craft, mavlink::RadioStatus const& heard, base::TimePoint now);

/// The vehicle's own clock, in messages that carry it.
[[nodiscard]] std::optional<base::Duration> boot_time(mavlink::Message const& message);

/// The number of a message that `wanted_messages` may name.
[[nodiscard]] std::optional<mavlink::MessageId> id_of(mavlink::Message const& message);

/// What the map and the mission runs need, and how often, from a vehicle of this autopilot.
[[nodiscard]] std::span<WantedMessage const> wanted_messages(vehicle::Autopilot autopilot);

}  // namespace lapwing::fleet
