#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "map/grid/cell_box.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::formats::internal {

/// More are read and written by no format: 400 MB at a byte each.
inline constexpr std::int64_t most_cells = 400'000'000;

/// The smallest box with every cell that was seen. Errors, invalid_input: nothing was seen; more than `most_cells`.
[[nodiscard]] base::Result<map::CellBox> seen_cells(map::OccupancyGrid const& grid, std::string const& name);

}  // namespace lapwing::formats::internal
