#pragma once

#include <cstdint>
#include <optional>

#include "map/grid/occupancy_grid.hpp"

namespace lapwing::map {

/// A rectangle of whole cells.
struct CellBox {
  Cell least;
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// The smallest one with every cell that was seen, so that no map is written with a wide empty edge; nothing when no
/// cell was.
[[nodiscard]] std::optional<CellBox> seen_box(OccupancyGrid const& grid);

}  // namespace lapwing::map
