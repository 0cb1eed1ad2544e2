#pragma once

#include <string>
#include <string_view>

#include "map/live/live_map.hpp"
#include "station/http/http.hpp"
#include "station/messages/feed_json.hpp"

/// What OGC API Features 1.0 and OGC API Tiles 1.0 want to know of a map before they ask for what lies on it. For .cpp
/// files.
namespace lapwing::station {

[[nodiscard]] Json ogc_landing_page(std::string const& origin);
[[nodiscard]] Json ogc_conformance();
/// Each layer, and each grid.
[[nodiscard]] Json ogc_collections(map::LiveMap const& map, std::string const& origin);
[[nodiscard]] Json ogc_layer(map::LiveMap const& map, map::LayerKind layer, std::string const& origin);

/// By which a grid is a collection: "grid:office:1:floor".
[[nodiscard]] std::string grid_collection(map::GridKey const& key);
/// Null when there is none of that name.
[[nodiscard]] map::GridRecord const* grid_of_collection(map::LiveMap const& map, std::string_view collection,
                                                        map::GridKey& key);
[[nodiscard]] Json ogc_grid(map::LiveMap const& map, map::GridKey const& key, std::string const& origin);
[[nodiscard]] Json ogc_tilesets(map::LiveMap const& map, map::GridKey const& key, std::string const& origin);
[[nodiscard]] Json ogc_tileset(map::LiveMap const& map, map::GridKey const& key, std::string const& origin);
[[nodiscard]] Json ogc_web_mercator_quad(std::string const& origin);

/// TileJSON 3.0, for MapLibre, QGIS and others.
[[nodiscard]] Json tile_json(map::LiveMap const& map, map::GridKey const& key, std::string const& origin);

inline constexpr std::string_view web_mercator_quad = "WebMercatorQuad";

}  // namespace lapwing::station
