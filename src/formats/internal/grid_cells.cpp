#include "formats/internal/grid_cells.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lapwing::formats::internal {

base::Result<CellBox> seen_cells(map::OccupancyGrid const& grid, std::string const& name) {
  map::Cell least{INT32_MAX, INT32_MAX};
  map::Cell most{INT32_MIN, INT32_MIN};
  for (auto const& [key, tile] : grid.tiles()) {
    for (std::int32_t i = 0; i < map::tile_cells * map::tile_cells; ++i) {
      if (!tile->cells[static_cast<std::size_t>(i)].is_seen()) continue;
      map::Cell const cell{key.x * map::tile_cells + i % map::tile_cells,
                           key.y * map::tile_cells + i / map::tile_cells};
      least = {std::min(least.x, cell.x), std::min(least.y, cell.y)};
      most = {std::max(most.x, cell.x), std::max(most.y, cell.y)};
    }
  }
  if (least.x > most.x)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("nothing was seen in the grid {}: there is no map to write", name));
  CellBox const box{least, std::int64_t{most.x} - least.x + 1, std::int64_t{most.y} - least.y + 1};
  if (box.width * box.height > most_cells)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("the grid {} has {} x {} cells, more than 400 million", name, box.width, box.height),
                      "write a part of it, or one of coarser cells");
  return box;
}

}  // namespace lapwing::formats::internal
