#pragma once

#include <map>
#include <memory>
#include <string>

#include "geo/position.hpp"
#include "geo/site.hpp"
#include "geo/transform.hpp"
#include "map/grid/grid_pyramid.hpp"
#include "map/live/live_map.hpp"

namespace lapwing::map {

/// Where a grid lies, and how large its cells are.
struct GridPlace {
  double resolution_m = 1.0;
  geo::Transform<geo::SiteFrame, GridFrame> site_from_grid = {};
  geo::Wgs84 anchor = {};  ///< of its site
};

[[nodiscard]] inline bool has_same_cells(GridPlace const& a, GridPlace const& b) {
  return a.resolution_m == b.resolution_m && a.site_from_grid.origin() == b.site_from_grid.origin() &&
         a.site_from_grid.yaw_rad() == b.site_from_grid.yaw_rad();
}

/// A grid as it was shown at some moment.
struct PastGrid {
  GridPlace place = {};
  /// How each tile looked, by a name that is made of its shades: alike tiles have one name.
  std::map<TileKey, std::string> tiles = {};
};

using PastGrids = std::map<GridKey, PastGrid>;
using PastShades = std::map<std::string, std::shared_ptr<TileShades const>>;

}  // namespace lapwing::map
