#pragma once

#include <optional>
#include <string_view>

#include "map/grid/grid_tiles.hpp"
#include "station/map/geo_words.hpp"

/// The tiles of web maps (OGC's WebMercatorQuad, EPSG:3857): at zoom z the world is 2^z tiles wide and high.
namespace lapwing::station {

/// Of three numbers as addresses have them; nothing when there is no such tile.
[[nodiscard]] std::optional<map::XyzTile> tile_address(std::string_view zoom, std::string_view x, std::string_view y);
[[nodiscard]] LonLatBox bounds_of(map::XyzTile const& tile);
/// In which a place lies; latitudes beyond the map's edge count as it.
[[nodiscard]] map::XyzTile tile_at(int zoom, double lon_deg, double lat_deg);

}  // namespace lapwing::station
