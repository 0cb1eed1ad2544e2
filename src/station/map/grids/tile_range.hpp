#pragma once

#include <optional>

#include "geo/site.hpp"
#include "map/grid/grid_tiles.hpp"

namespace lapwing::station {

/// Which of a grid's tiles a picture may show.
struct TileRange {
  map::TileKey least;
  map::TileKey most;

  [[nodiscard]] bool contains(map::TileKey const& key) const {
    return least.x <= key.x && key.x <= most.x && least.y <= key.y && key.y <= most.y;
  }
};

/// Nothing when it shows none of the site.
[[nodiscard]] std::optional<TileRange> tiles_under(double resolution_m,
                                                   geo::Transform<geo::SiteFrame, map::GridFrame> const& site_from_grid,
                                                   geo::Site const& site, map::XyzTile const& tile);

}  // namespace lapwing::station
