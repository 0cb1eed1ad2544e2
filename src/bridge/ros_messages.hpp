#pragma once

#include "base/time.hpp"
#include "bridge/flight_controller.hpp"
#include "bus/messages/mavros.hpp"
#include "bus/messages/sensors.hpp"

/// What a flight controller says, as MAVROS says it on the bus. Values in, values out.
namespace lapwing::bridge {

[[nodiscard]] bus::mavros::State ros_state(FlightController const& flight, base::TimePoint now);
[[nodiscard]] bus::mavros::SysStatus ros_system_status(mavlink::SysStatus const& status);
/// Discharging is a negative current, as sensor_msgs has it; what is not known is not a number.
[[nodiscard]] bus::BatteryState ros_battery(mavlink::SysStatus const& status);
/// `geoid_m`: how far mean sea level lies above the ellipsoid there. Precondition: the position is known.
[[nodiscard]] bus::NavSatFix ros_fix(mavlink::GlobalPosition const& position, std::optional<mavlink::GpsRaw> const& gps,
                                     double geoid_m);
/// Its place in the local frame follows from that frame's origin: ArduPilot tells zeros instead.
[[nodiscard]] bus::mavros::HomePosition ros_home(geo::Wgs84 home, geo::Wgs84 origin, double geoid_m);

}  // namespace lapwing::bridge
