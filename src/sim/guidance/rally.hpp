#pragma once

#include "sim/guidance/flight_context.hpp"

namespace lapwing::sim {

/// Where a return leads: home, or a rally point by ArduPilot's rule (AP_Rally): the nearest one, unless it is beyond
/// RALLY_LIMIT_KM or home counts as well (RALLY_INCL_HOME) and is nearer. `down` of a rally point is the height to fly
/// to it at.
struct ReturnPlace {
  geo::Ned point;
  bool is_rally = false;
};
[[nodiscard]] ReturnPlace return_place(FlightContext const& context);

}  // namespace lapwing::sim
