#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "plan/plan.hpp"
#include "plan/plausibility/vehicle_fence.hpp"
#include "vehicle/family.hpp"

namespace lapwing::plan::plausibility {

/// Another vehicle, as far as it can be in the way on the ground.
struct Neighbour {
  std::string name;
  std::optional<geo::Wgs84> stands = std::nullopt;  ///< on the ground
  std::vector<geo::Wgs84> lands_at = {};            ///< by the missions that it flies now
};

/// What is known when somebody wants a vehicle to move. What is not known is not judged.
struct Situation {
  std::string vehicle = "the vehicle";  ///< for people
  vehicle::Family family = vehicle::Family::unknown;
  vehicle::Autopilot autopilot = vehicle::Autopilot::other;
  std::optional<geo::Wgs84> position = std::nullopt;
  std::optional<geo::Wgs84> home = std::nullopt;  ///< its own, as it is before the mission moves it
  std::optional<bool> on_ground = std::nullopt;
  std::optional<int> items_held = std::nullopt;            ///< of a mission, without home
  std::optional<GeoFence> fence = std::nullopt;            ///< of the plan that is uploaded along
  std::optional<VehicleFence> own_fence = std::nullopt;    ///< while it is switched on
  std::optional<base::Duration> endurance = std::nullopt;  ///< what is left of the battery
  std::vector<Neighbour> neighbours = {};
};

}  // namespace lapwing::plan::plausibility
