#include "formats/internal/grid_cells.hpp"

#include <fmt/format.h>

namespace lapwing::formats::internal {

base::Result<map::CellBox> seen_cells(map::OccupancyGrid const& grid, std::string const& name) {
  auto const box = map::seen_box(grid);
  if (!box)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("nothing was seen in the grid {}: there is no map to write", name));
  if (box->width * box->height > most_cells)
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("the grid {} has {} x {} cells, more than 400 million", name, box->width, box->height),
        "write a part of it, or one of coarser cells");
  return *box;
}

}  // namespace lapwing::formats::internal
