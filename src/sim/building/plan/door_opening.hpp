#pragma once

#include <optional>
#include <span>
#include <vector>

#include "sim/building/plan/building_plan.hpp"

namespace lapwing::sim::building {

/// Where a door's jambs stand in a wall, in metres from the wall's beginning.
struct Opening {
  std::size_t wall = 0;
  double begin_m = 0.0;
  double end_m = 0.0;
};

/// In the wall in whose middle line both jambs stand, to a centimetre; nothing where there is no such wall.
[[nodiscard]] std::optional<Opening> opening_of(DoorPlan const& door, std::span<WallPlan const> walls);

/// What is left of one wall beside the openings in it, in order from its beginning. Openings may overlap.
struct Stretch {
  double begin_m = 0.0;
  double end_m = 0.0;
};
[[nodiscard]] std::vector<Stretch> stretches_between(double length_m, std::vector<Opening> openings);

}  // namespace lapwing::sim::building
