#include "station/map/grids/tile_range.hpp"

#include <cmath>
#include <cstdint>

#include "station/map/geo_words.hpp"
#include "station/map/grids/web_mercator.hpp"

namespace lapwing::station {

std::optional<TileRange> tiles_under(double resolution_m,
                                     geo::Transform<geo::SiteFrame, map::GridFrame> const& site_from_grid,
                                     geo::Site const& site, map::XyzTile const& tile) {
  constexpr TileRange all{{INT32_MIN, INT32_MIN}, {INT32_MAX, INT32_MAX}};
  auto const reach = reach_of(bounds_of(tile), site);
  if (reach.is_empty) return std::nullopt;
  if (!reach.box) return all;
  auto const grid_from_site = site_from_grid.inverse();
  std::optional<geo::Box<map::GridFrame>> box;
  for (double const x : {reach.box->least.x(), reach.box->most.x()}) {
    for (double const y : {reach.box->least.y(), reach.box->most.y()}) {
      auto const corner = grid_from_site * map::SitePoint(x, y);
      if (!box) box = geo::Box<map::GridFrame>{corner, corner};
      box->least.v = box->least.v.cwiseMin(corner.v);
      box->most.v = box->most.v.cwiseMax(corner.v);
    }
  }
  double const side_m = resolution_m * map::tile_cells;
  // The plane reaches 100 km: at a millimetre a cell that is 390,625 tiles, which fits.
  auto const index = [side_m](double metres) { return static_cast<std::int32_t>(std::floor(metres / side_m)); };
  return TileRange{{index(box->least.x()), index(box->least.y())}, {index(box->most.x()), index(box->most.y())}};
}

}  // namespace lapwing::station
