#pragma once

#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "station/http/router.hpp"
#include "vehicle/modules.hpp"

/// What is told of the modules of vehicles, and its HTTP face: "Health" in docs/reference/station-messages.md.
namespace lapwing::station {

[[nodiscard]] std::string health_message(std::vector<vehicle::ModulesOfVehicle> const& vehicles);

/// `modules` may be null: then there are none. `loop` outlives the router.
void add_health_route(Router& router, vehicle::VehicleModules const* modules, base::Loop const& loop);

}  // namespace lapwing::station
