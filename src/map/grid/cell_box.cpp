#include "map/grid/cell_box.hpp"

#include <algorithm>

namespace lapwing::map {

std::optional<CellBox> seen_box(OccupancyGrid const& grid) {
  Cell least{INT32_MAX, INT32_MAX};
  Cell most{INT32_MIN, INT32_MIN};
  for (auto const& [key, tile] : grid.tiles()) {
    for (std::int32_t i = 0; i < tile_cells * tile_cells; ++i) {
      if (!tile->cells[static_cast<std::size_t>(i)].is_seen()) continue;
      Cell const cell{key.x * tile_cells + i % tile_cells, key.y * tile_cells + i / tile_cells};
      least = {std::min(least.x, cell.x), std::min(least.y, cell.y)};
      most = {std::max(most.x, cell.x), std::max(most.y, cell.y)};
    }
  }
  if (least.x > most.x) return std::nullopt;
  return CellBox{least, std::int64_t{most.x} - least.x + 1, std::int64_t{most.y} - least.y + 1};
}

}  // namespace lapwing::map
