#pragma once

#include "base/error.hpp"
#include "bus/messages/geographic.hpp"
#include "geo/position.hpp"
#include "mavlink/codec/messages.hpp"

/// Where programs on the bus want the vehicle, as MAVLink says it: always a place on the globe above mean sea level
/// (SET_POSITION_TARGET_GLOBAL_INT), which means the same whatever the autopilot takes for its local frame. Zeros as
/// orientation leave the heading to the autopilot. Error (invalid_input): no numbers, or no place on Earth.
namespace lapwing::bridge {

/// `origin`: of the local frame, as the autopilot tells it.
[[nodiscard]] base::Result<mavlink::SetPositionTargetGlobalInt> setpoint_of(bus::PoseStamped const& wanted,
                                                                            geo::Wgs84 origin);
/// `geoid_m`: how far mean sea level lies above the ellipsoid there.
[[nodiscard]] base::Result<mavlink::SetPositionTargetGlobalInt> setpoint_of(bus::GeoPoseStamped const& wanted,
                                                                            double geoid_m);

}  // namespace lapwing::bridge
