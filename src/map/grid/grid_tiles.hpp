#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "geo/site.hpp"
#include "map/grid/grid_pyramid.hpp"

/// Occupancy grids as the tiles that web maps and GIS programs ask for (XYZ: web Mercator, EPSG:3857, from the north
/// west, 256 pixels a side). Pure functions: they run on the pool.
namespace lapwing::map {

struct XyzTile {
  int zoom = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend auto operator<=>(XyzTile const&, XyzTile const&) = default;
};

inline constexpr int tile_px = 256;
/// A tile farther out is larger than the map of a site, and its grids are specks.
inline constexpr int lowest_zoom = 10;
/// A pixel is 5 mm there.
inline constexpr int highest_zoom = 25;

/// Within the zooms that are drawn, and on the globe.
[[nodiscard]] bool is_drawn(XyzTile tile);

/// Row by row from the north, for each pixel what of the grid is in it: zoomed in, the cell in its middle; zoomed out,
/// the greatest shade of the cells in it, so that what is taken stays to be seen. Nothing where nothing was seen, or
/// the tile is not drawn.
[[nodiscard]] std::optional<std::vector<Shade>> render(GridPyramid const& grid, geo::Site const& site, XyzTile tile);

/// The XYZ tiles of one zoom in which these tiles of a grid lie, in order, each once: what to draw anew when they
/// change. At most `most`, as a zoom far in has any number of them. Precondition: a zoom that is drawn.
[[nodiscard]] std::vector<XyzTile> tiles_with(double resolution_m,
                                              geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid,
                                              std::span<TileKey const> changed, geo::Site const& site, int zoom,
                                              std::size_t most);

}  // namespace lapwing::map
