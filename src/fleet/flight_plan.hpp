#pragma once

#include <string>
#include <vector>

#include "fleet/mission_end.hpp"
#include "plan/mission.hpp"

namespace lapwing::fleet {

/// A mission made ready for one vehicle.
struct FlightPlan {
  std::vector<mavlink::MissionItem> items;  ///< as they are uploaded
  std::uint16_t first_seq = 0;              ///< of the first item that is flown: 1 where item 0 is home
  MissionShape shape;
  std::vector<geo::Wgs84> path;  ///< places to fly to, in the order of the items

  [[nodiscard]] int last_seq() const { return static_cast<int>(items.size()) - 1; }
};

[[nodiscard]] FlightPlan flight_plan(plan::Mission const& mission, vehicle::VehicleState const& vehicle);

}  // namespace lapwing::fleet
