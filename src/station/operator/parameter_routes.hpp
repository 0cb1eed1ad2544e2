#pragma once

#include "station/http/router.hpp"
#include "vehicle/parameters.hpp"

namespace lapwing::station {

/// The HTTP face of vehicles' parameters. Null: there are none, all is refused. They outlive the router and its work.
void add_parameter_routes(Router& router, vehicle::VehicleParameters* parameters);

}  // namespace lapwing::station
