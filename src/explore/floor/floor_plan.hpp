#pragma once

#include "base/error.hpp"
#include "explore/floor/dense_grid.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::explore {

/// A floor as it is drawn: what is free, and everything else, through which nobody sees or drives.
struct FloorPlan {
  double cell_m = 0.0;
  DenseGrid<std::uint8_t> is_free;
  geo::Transform<geo::SiteFrame, FloorFrame> site_from_floor;
};

/// More cells than this are refused: the memory of a run grows with them.
inline constexpr std::int64_t most_floor_cells = 64'000'000;

/// Of a map as it was read: cells surely free are free, those that are taken or were never seen are not. Cells larger
/// than 0.1 m are divided, so that a door as wide as four of them still lets a robot pass. Errors, invalid_input:
/// nothing free, too large.
[[nodiscard]] base::Result<FloorPlan> floor_plan_of(map::OccupancyGrid const& grid);

}  // namespace lapwing::explore
