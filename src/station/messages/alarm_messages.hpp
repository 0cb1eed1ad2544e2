#pragma once

#include <string>

#include "base/async/loop.hpp"
#include "station/http/router.hpp"
#include "vehicle/alarm.hpp"

/// What is told of alarms, and their HTTP face: "Alarms" in docs/reference/station-messages.md.
namespace lapwing::station {

/// Without `alarms` there are none.
[[nodiscard]] std::string alarms_message(vehicle::VehicleAlarms const* alarms, base::TimePoint now);

/// `alarms` may be null; `loop` outlives the router.
void add_alarm_routes(Router& router, vehicle::VehicleAlarms* alarms, base::Loop const& loop);

}  // namespace lapwing::station
