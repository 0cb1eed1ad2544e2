#pragma once

#include "base/log.hpp"
#include "station/http/router.hpp"
#include "vehicle/control.hpp"

namespace lapwing::station {

/// The HTTP face of `control`: commands, the emergency stop, who commands a vehicle. Null: all is refused. Both outlive
/// the router.
void add_control_routes(Router& router, vehicle::VehicleControl* control, base::Logger const& log);

}  // namespace lapwing::station
