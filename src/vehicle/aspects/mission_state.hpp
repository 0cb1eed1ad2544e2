#pragma once

#include <string_view>
#include <vector>

#include "geo/position.hpp"
#include "vehicle/aged.hpp"

namespace lapwing::vehicle {

/// Where the vehicle stands in the mission it holds.
struct MissionProgress {
  int current_seq = 0;
  int total = 0;
  bool complete = false;
  std::string_view state = {};  ///< "active", "paused" ...; empty when the vehicle does not say
};

struct Fence {
  bool is_breached = false;
  int breaches = 0;            ///< since boot
  std::string_view type = {};  ///< of the last breach: "maximum altitude"; empty for none
};

/// Where it is bound for, and where it must not go.
struct MissionState {
  Aged<MissionProgress> progress;
  Aged<double> waypoint_distance_m;      ///< to where it is flying now
  Aged<geo::Wgs84> position_target;      ///< where it is flying now, as it tells; latitude and longitude count
  std::vector<geo::Wgs84> planned_path;  ///< positions of the mission it holds, in flight order, for the map
  Aged<Fence> fence;
};

}  // namespace lapwing::vehicle
