#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"
#include "map/grid/occupancy_grid.hpp"
#include "map/live/live_map.hpp"

namespace lapwing::formats {

/// A map as it goes into files and comes out of them. Features and grids name sites that are in `sites`.
struct MapContents {
  std::map<std::string, geo::Site, std::less<>> sites;
  std::vector<map::Feature> features;
  std::map<map::GridKey, map::OccupancyGrid> grids;
};

/// The bytes of a picture by its content hash. Error: not_found.
using ReadBlob = std::function<base::Result<std::string>(std::string const& hash)>;

}  // namespace lapwing::formats
