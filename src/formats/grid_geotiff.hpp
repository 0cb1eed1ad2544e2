#pragma once

#include <filesystem>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::formats {

/// A grid as cloud optimized GeoTIFF, in the plane of its site, turned as the grid is, so that no cell is resampled.
/// Band 1, `occupancy`: percent, -32768 (no data) where nothing was seen. Band 2, `log odds`: in steps of 1/256, exact.
/// Errors: invalid_input for an empty grid; io.
[[nodiscard]] base::Result<> write_grid_geotiff(map::OccupancyGrid const& grid, geo::Site const& site,
                                                std::filesystem::path const& path);

/// Reads what `write_grid_geotiff` wrote, and any other GeoTIFF of one band with percent or probabilities from 0 to 1
/// in a metric projection; pixels must be squares. The grid lies in `site`. Errors: invalid_input; io.
[[nodiscard]] base::Result<map::OccupancyGrid> read_grid_geotiff(std::filesystem::path const& path,
                                                                 geo::Site const& site);

}  // namespace lapwing::formats
