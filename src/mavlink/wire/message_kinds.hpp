#pragma once

#include <cstdint>

#include "link/byte_link.hpp"
#include "mavlink/wire/frame.hpp"

/// What kind of talk a message is, where several links lead to one vehicle or one link is slow. By the wire's ids: most
/// of these are messages that this program passes on and never decodes.
namespace lapwing::mavlink::internal {

/// What a message asks of the link that carries it.
enum class Traffic {
  command,  ///< little, must arrive soon: commands, missions, acknowledgements
  bulk,     ///< much, may take its time: parameters, files, logs, corrections
};
[[nodiscard]] Traffic traffic_of(std::uint32_t message_id);

/// How soon it is wanted at the far end. Perishable: what is worth little when it is late, because the next one says it
/// anew (heartbeats, setpoints, corrections). Urgent: what may stop a vehicle (a mode, return, land, disarm,
/// terminate).
[[nodiscard]] link::Urgency urgency_of(Frame const& frame);

/// Where to go, which way to lie, or what to do with the motors, now: SET_ATTITUDE_TARGET,
/// SET_POSITION_TARGET_LOCAL_NED and _GLOBAL_INT, SET_ACTUATOR_CONTROL_TARGET.
[[nodiscard]] bool is_setpoint(std::uint32_t message_id);

/// A report that a vehicle repeats on each of its links, at each link's own rate. Of several links to one vehicle one
/// speaks for such a message.
[[nodiscard]] bool tells_state(std::uint32_t message_id);

/// What a vehicle tells once, on each of its links.
[[nodiscard]] bool tells_event(std::uint32_t message_id);

/// Helps to tell one vehicle from another: TIMESYNC, AUTOPILOT_VERSION, GLOBAL_POSITION_INT.
[[nodiscard]] inline bool tells_identity(MessageId id) {
  return id == MessageId::timesync || id == MessageId::autopilot_version || id == MessageId::global_position_int;
}

/// Carries the vehicle's clock in milliseconds or finer: two vehicles hardly ever send the same one.
[[nodiscard]] bool carries_clock(std::uint32_t message_id);

}  // namespace lapwing::mavlink::internal
