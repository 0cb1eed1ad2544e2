#pragma once

#include <span>
#include <vector>

#include "geo/position.hpp"
#include "mavlink/codec/messages.hpp"
#include "vehicle/family.hpp"

namespace lapwing::fleet {

/// A place that a mission goes to, and how near to it a vehicle comes that carries out the item.
struct PlannedPlace {
  int seq = 0;  ///< of the item, as on the vehicle
  geo::Wgs84 at;
  double radius_m = 0.0;  ///< generous: for the vehicle's own idea of "reached", for circles, for corners that are cut
};

/// The places that the vehicle comes to before the mission's end, in the order of their items. `items` are numbered as
/// on the vehicle, up to the last one that is ever begun; the mission begins at `first`. Jumps are followed; what none
/// of them leads to is not there. A take-off is none (it goes up where the vehicle stands), nor is an item that says
/// "here".
[[nodiscard]] std::vector<PlannedPlace> planned_places(std::span<mavlink::MissionItem const> items, std::size_t first,
                                                       vehicle::Autopilot autopilot, vehicle::Family family);

}  // namespace lapwing::fleet
