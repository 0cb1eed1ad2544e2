#include "station/map/grids/grid_json.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "map/features/placement.hpp"
#include "map/grid/grid_tiles.hpp"
#include "station/http/http.hpp"

namespace lapwing::station {

namespace {

Json lon_lat(double lon_deg, double lat_deg) {
  return Json::array({rounded(lon_deg, 9), rounded(lat_deg, 9)});
}

/// Where the lower left corner of tile (0, 0) lies, and how far it is to the next one along x and along y. The globe is
/// flat enough for that: a few decimetres off after a kilometre.
Json tiling(map::OccupancyGrid const& grid, geo::Site const& site) {
  double const side_m = grid.resolution_m() * map::tile_cells;
  auto const corner = [&](double x_m, double y_m) {
    return map::place_of(site, grid.site_from_grid() * geo::Point<map::GridFrame>(x_m, y_m));
  };
  auto const origin = corner(0.0, 0.0);
  auto const along_x = corner(side_m, 0.0);
  auto const along_y = corner(0.0, side_m);
  return {{"origin", lon_lat(origin.lon_deg(), origin.lat_deg())},
          {"x", lon_lat(along_x.lon_deg() - origin.lon_deg(), along_x.lat_deg() - origin.lat_deg())},
          {"y", lon_lat(along_y.lon_deg() - origin.lon_deg(), along_y.lat_deg() - origin.lat_deg())}};
}

}  // namespace

std::optional<LonLatBox> grid_bounds(map::OccupancyGrid const& grid, geo::Site const& site) {
  auto const extent = grid.extent();
  if (!extent) return std::nullopt;
  std::optional<map::SiteBox> box;
  for (double const x : {extent->least.x(), extent->most.x()}) {
    for (double const y : {extent->least.y(), extent->most.y()}) {
      auto const corner = grid.site_from_grid() * geo::Point<map::GridFrame>(x, y);
      if (!box) box = map::SiteBox{corner, corner};
      box->least.v = box->least.v.cwiseMin(corner.v);
      box->most.v = box->most.v.cwiseMax(corner.v);
    }
  }
  return lon_lat_bounds(*box, site);
}

int finest_zoom(map::OccupancyGrid const& grid, geo::Site const& site) {
  constexpr double equator_m = 40'075'016.686;
  constexpr double picture_px = 256.0;
  double const pixel_at_zoom_0_m = equator_m * std::cos(site.anchor().lat_rad) / picture_px;
  return std::clamp(static_cast<int>(std::ceil(std::log2(pixel_at_zoom_0_m / grid.resolution_m()))), map::lowest_zoom,
                    map::highest_zoom);
}

Json grid_json(map::GridKey const& key, map::GridRecord const& record, geo::Site const& site) {
  Json json{{"site", key.site},
            {"floor", key.floor},
            {"name", key.name},
            {"resolution_m", rounded(record.grid.resolution_m(), 6)},
            {"writer", record.account.writer},
            {"at", base::utc_text(record.account.at)},
            {"tile_cells", map::tile_cells},
            {"tiling", tiling(record.grid, site)}};
  if (auto const box = grid_bounds(record.grid, site))
    json["bounds"] = {rounded(box->west, 7), rounded(box->south, 7), rounded(box->east, 7), rounded(box->north, 7)};
  return json;
}

std::string grid_pictures(map::GridKey const& key, std::string_view run, map::Revision revision) {
  // A grid of the site's ground has no floor, and a part of a path is never empty.
  return fmt::format("/api/v1/grids/{}/{}/{}/tiles/{{z}}/{{x}}/{{y}}.png?revision={}-{}", percent_encoded(key.site),
                     key.floor.empty() ? "-" : percent_encoded(key.floor), percent_encoded(key.name), run, revision);
}

}  // namespace lapwing::station
