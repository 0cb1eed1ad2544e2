#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::formats::internal {

/// More are read and written by no format: 400 MB at a byte each.
inline constexpr std::int64_t most_cells = 400'000'000;

/// A rectangle of whole cells.
struct CellBox {
  map::Cell least;
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// The smallest one with every cell that was seen, so that a plan is not written with a wide empty edge. Errors,
/// invalid_input: nothing was seen; more than `most_cells`.
[[nodiscard]] base::Result<CellBox> seen_cells(map::OccupancyGrid const& grid, std::string const& name);

}  // namespace lapwing::formats::internal
