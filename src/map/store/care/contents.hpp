#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "map/live/live_map.hpp"

namespace lapwing::map::care {

/// What lies on the map that a store keeps, without its past and without the bytes of pictures.
struct Contents {
  std::map<std::string, geo::Site, std::less<>> sites;
  std::vector<Feature> features;
  std::map<GridKey, OccupancyGrid> grids;
};

/// Reads only, also while a station writes. Errors, io: no store, or rows in it that hold no feature.
[[nodiscard]] base::Result<Contents> read_contents(std::string const& address);
/// A picture's bytes by their hash. Errors: not_found; io.
[[nodiscard]] base::Result<std::string> read_picture(std::string const& address, std::string const& hash);

}  // namespace lapwing::map::care
