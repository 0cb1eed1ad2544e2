#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fleet/mission/mission_end.hpp"
#include "fleet/watch/planned_places.hpp"
#include "plan/mission.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

/// A mission made ready for one vehicle.
struct FlightPlan {
  std::vector<mavlink::MissionItem> items;  ///< as they are uploaded
  std::uint16_t first_seq = 0;              ///< of the first item that is flown: 1 where item 0 is home
  MissionShape shape;
  std::vector<geo::Wgs84> path;      ///< places to fly to, in the order of the items
  std::vector<PlannedPlace> places;  ///< that it has passed when it is done
  std::optional<geo::Wgs84> home;    ///< as it is in flight

  [[nodiscard]] int last_seq() const { return static_cast<int>(items.size()) - 1; }
  /// Without the one that ArduPilot keeps home in: as vehicles count what they hold.
  [[nodiscard]] int flown_items() const { return static_cast<int>(items.size()) - first_seq; }
};

[[nodiscard]] FlightPlan flight_plan(plan::Mission const& mission, vehicle::VehicleState const& vehicle);

}  // namespace lapwing::fleet
