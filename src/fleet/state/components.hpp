#pragma once

#include <string_view>
#include <vector>

#include "mavlink/codec/messages.hpp"
#include "vehicle/equipment.hpp"

namespace lapwing::fleet {

/// What sends such heartbeats aboard a vehicle besides its autopilot: "camera", "gimbal", "companion computer" ...;
/// "component" where neither MAV_TYPE nor the component's number tells. Empty for what is no part of a vehicle (its
/// autopilot, ground stations whose heartbeats it forwards).
[[nodiscard]] std::string_view component_kind(mavlink::Address source, mavlink::Heartbeat const& heartbeat);

/// The entry for the component, made when there is none; null when the list is full. One number may stand for two:
/// an autopilot speaks for the camera and the gimbal that are wired to it.
vehicle::Component* component_of(std::vector<vehicle::Component>& all, int id, std::string_view kind);

/// "active", "standby" ..., for people.
[[nodiscard]] std::string_view state_word(mavlink::MavState state);

}  // namespace lapwing::fleet
