#include "station/map/ogc/ogc_documents.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "map/features/geometry.hpp"
#include "station/map/features/feature_documents.hpp"
#include "station/map/grids/grid_json.hpp"
#include "station/map/grids/web_mercator.hpp"

namespace lapwing::station {

namespace {

constexpr std::string_view crs84 = "http://www.opengis.net/def/crs/OGC/1.3/CRS84";
constexpr std::string_view web_mercator = "http://www.opengis.net/def/crs/EPSG/0/3857";
constexpr std::string_view quad_uri = "http://www.opengis.net/def/tilematrixset/OGC/1.0/WebMercatorQuad";
constexpr std::string_view map_tilesets = "http://www.opengis.net/def/rel/ogc/1.0/tilesets-map";
constexpr std::string_view tiling_scheme = "http://www.opengis.net/def/rel/ogc/1.0/tiling-scheme";

std::string title_of(map::LayerKind layer) {
  auto title = std::string(map::name_of(layer));
  std::ranges::replace(title, '_', ' ');
  title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

Json extent_json(std::vector<LonLatBox> const& boxes) {
  auto all = boxes.front();
  for (auto const& box : boxes) {
    all = {std::min(all.west, box.west), std::min(all.south, box.south), std::max(all.east, box.east),
           std::max(all.north, box.north)};
  }
  return {{"spatial",
           {{"bbox", Json::array({Json::array(
                         {rounded(all.west, 7), rounded(all.south, 7), rounded(all.east, 7), rounded(all.north, 7)})})},
            {"crs", crs84}}}};
}

/// Round everything of a layer, a rectangle a site.
std::vector<LonLatBox> bounds_of_layer(map::LiveMap const& map, map::LayerKind layer) {
  std::vector<LonLatBox> boxes;
  for (auto const& [id, site] : map.sites()) {
    std::optional<map::SiteBox> all;
    for (auto const* record : map.within(layer, id, std::nullopt, std::numeric_limits<std::size_t>::max())) {
      auto const one = map::bounds(map::geometry_of(record->feature.content));
      if (!all) all = one;
      all->least.v = all->least.v.cwiseMin(one.least.v);
      all->most.v = all->most.v.cwiseMax(one.most.v);
    }
    if (all) boxes.push_back(lon_lat_bounds(*all, site));
  }
  return boxes;
}

std::string collection_address(std::string const& origin, std::string_view collection) {
  return fmt::format("{}/ogc/collections/{}", origin, percent_encoded(collection));
}

std::string tileset_address(std::string const& origin, map::GridKey const& key) {
  return fmt::format("{}/map/tiles/{}", collection_address(origin, grid_collection(key)), web_mercator_quad);
}

std::string pictures_address(std::string const& origin, map::GridKey const& key) {
  auto address = origin + grid_pictures(key, "", 0);
  return address.substr(0, address.find('?'));
}

/// With the words of a tile matrix set in place of {z}, {x} and {y}.
std::string pictures_by_matrix(std::string const& origin, map::GridKey const& key) {
  auto address = pictures_address(origin, key);
  address.resize(address.size() - std::string_view("{z}/{x}/{y}.png").size());
  return address + "{tileMatrix}/{tileCol}/{tileRow}.png";
}

std::string title_of(map::GridKey const& key) {
  return fmt::format("{}{}{}: {}", key.site, key.floor.empty() ? "" : ", floor ", key.floor, key.name);
}

Json tileset_json(map::GridKey const& key) {
  return {{"title", title_of(key)}, {"dataType", "map"}, {"crs", web_mercator}, {"tileMatrixSetURI", quad_uri}};
}

}  // namespace

Json ogc_landing_page(std::string const& origin) {
  auto const base = origin + "/ogc";
  return {{"title", "Lapwing map"},
          {"description",
           "What lies on the map of this ground station: slots, walls, points of interest, pictures, tracks, areas and "
           "grids."},
          {"links", links_json({{"self", base},
                                {"service-desc", base + "/api", "application/vnd.oai.openapi+json;version=3.0"},
                                {"conformance", base + "/conformance"},
                                {"data", base + "/collections"},
                                {"http://www.opengis.net/def/rel/ogc/1.0/tiling-schemes", base + "/tileMatrixSets"}})}};
}

Json ogc_conformance() {
  return {{"conformsTo",
           {"http://www.opengis.net/spec/ogcapi-common-1/1.0/conf/core",
            "http://www.opengis.net/spec/ogcapi-features-1/1.0/conf/core",
            "http://www.opengis.net/spec/ogcapi-features-1/1.0/conf/geojson",
            "http://www.opengis.net/spec/ogcapi-features-1/1.0/conf/oas30",
            "http://www.opengis.net/spec/ogcapi-tiles-1/1.0/conf/core",
            "http://www.opengis.net/spec/ogcapi-tiles-1/1.0/conf/tileset",
            "http://www.opengis.net/spec/ogcapi-tiles-1/1.0/conf/tilesets-list",
            "http://www.opengis.net/spec/ogcapi-tiles-1/1.0/conf/geodata-tilesets",
            "http://www.opengis.net/spec/ogcapi-tiles-1/1.0/conf/png"}}};
}

Json ogc_layer(map::LiveMap const& map, map::LayerKind layer, std::string const& origin) {
  auto const address = collection_address(origin, map::name_of(layer));
  Json json{
      {"id", map::name_of(layer)}, {"title", title_of(layer)}, {"itemType", "feature"}, {"crs", Json::array({crs84})}};
  if (auto const boxes = bounds_of_layer(map, layer); !boxes.empty()) json["extent"] = extent_json(boxes);
  json["links"] = links_json({{"self", address}, {"items", address + "/items", geojson_type}});
  return json;
}

Json ogc_collections(map::LiveMap const& map, std::string const& origin) {
  Json list = Json::array();
  for (auto const layer : map::all_layers) list.push_back(ogc_layer(map, layer, origin));
  for (auto const& [key, record] : map.grids()) list.push_back(ogc_grid(map, key, origin));
  return {{"links", links_json({{"self", origin + "/ogc/collections"}})}, {"collections", std::move(list)}};
}

std::string grid_collection(map::GridKey const& key) {
  return fmt::format("grid:{}:{}:{}", key.site, key.floor, key.name);
}

map::GridRecord const* grid_of_collection(map::LiveMap const& map, std::string_view collection, map::GridKey& key) {
  for (auto const& [one, record] : map.grids()) {
    if (grid_collection(one) != collection) continue;
    key = one;
    return &record;
  }
  return nullptr;
}

Json ogc_grid(map::LiveMap const& map, map::GridKey const& key, std::string const& origin) {
  auto const collection = grid_collection(key);
  auto const address = collection_address(origin, collection);
  // GDAL leaves out of its vector layers what is called a raster; there is no other word that it knows.
  Json json{{"id", collection},
            {"title", title_of(key)},
            {"dataType", "map"},
            {"layerDataType", "Raster"},
            {"itemType", "unknown"}};
  json["crs"] = Json::array({crs84});
  if (auto const box = grid_bounds(map.grids().at(key).grid, *map.site(key.site))) json["extent"] = extent_json({*box});
  json["links"] = links_json({{"self", address}, {std::string(map_tilesets), address + "/map/tiles"}});
  return json;
}

Json ogc_tilesets(map::LiveMap const&, map::GridKey const& key, std::string const& origin) {
  auto tileset = tileset_json(key);
  auto const address = tileset_address(origin, key);
  tileset["links"] = links_json({{"self", address}});
  return {{"links", links_json({{"self", address.substr(0, address.rfind('/'))}})},
          {"tilesets", Json::array({std::move(tileset)})}};
}

Json ogc_tileset(map::LiveMap const& map, map::GridKey const& key, std::string const& origin) {
  auto json = tileset_json(key);
  auto const& grid = map.grids().at(key).grid;
  auto const& site = *map.site(key.site);
  Json limits = Json::array();
  if (auto const box = grid_bounds(grid, site)) {
    for (int zoom = map::lowest_zoom; zoom <= finest_zoom(grid, site); ++zoom) {
      auto const least = tile_at(zoom, box->west, box->north);
      auto const most = tile_at(zoom, box->east, box->south);
      limits.push_back({{"tileMatrix", fmt::format("{}", zoom)},
                        {"minTileRow", least.y},
                        {"maxTileRow", most.y},
                        {"minTileCol", least.x},
                        {"maxTileCol", most.x}});
    }
  }
  json["tileMatrixSetLimits"] = std::move(limits);
  auto const address = tileset_address(origin, key);
  auto links =
      links_json({{"self", address},
                  {std::string(tiling_scheme), fmt::format("{}/ogc/tileMatrixSets/{}", origin, web_mercator_quad)},
                  {"item", pictures_by_matrix(origin, key), "image/png"}});
  links.back()["templated"] = true;
  json["links"] = std::move(links);
  return json;
}

Json ogc_web_mercator_quad(std::string const& origin) {
  constexpr double half_side_m = 20'037'508.342789244;
  constexpr double picture_px = 256.0;
  constexpr double pixel_of_scale_m = 0.00028;  // the standard's pixel
  Json matrices = Json::array();
  Json matrices_of_1_0 = Json::array();
  for (int zoom = 0; zoom <= map::highest_zoom; ++zoom) {
    double const tiles = std::exp2(zoom);
    double const cell_m = 2.0 * half_side_m / picture_px / tiles;
    auto const corner = Json::array({-half_side_m, half_side_m});
    matrices.push_back({{"id", fmt::format("{}", zoom)},
                        {"scaleDenominator", cell_m / pixel_of_scale_m},
                        {"cellSize", cell_m},
                        {"cornerOfOrigin", "topLeft"},
                        {"pointOfOrigin", corner},
                        {"tileWidth", 256},
                        {"tileHeight", 256},
                        {"matrixWidth", std::int64_t{1} << zoom},
                        {"matrixHeight", std::int64_t{1} << zoom}});
    matrices_of_1_0.push_back({{"type", "TileMatrixType"},
                               {"identifier", fmt::format("{}", zoom)},
                               {"scaleDenominator", cell_m / pixel_of_scale_m},
                               {"topLeftCorner", corner},
                               {"tileWidth", 256},
                               {"tileHeight", 256},
                               {"matrixWidth", std::int64_t{1} << zoom},
                               {"matrixHeight", std::int64_t{1} << zoom}});
  }
  // The second edition of the standard (17-083r4), and beside it the JSON of the first (17-083r2): GDAL before 3.8
  // reads no other, and knows it by its type.
  return {{"type", "TileMatrixSetType"},
          {"id", web_mercator_quad},
          {"identifier", web_mercator_quad},
          {"supportedCRS", web_mercator},
          {"boundingBox",
           {{"crs", web_mercator},
            {"lowerCorner", Json::array({-half_side_m, -half_side_m})},
            {"upperCorner", Json::array({half_side_m, half_side_m})}}},
          {"title", "Google Maps Compatible for the World"},
          {"uri", quad_uri},
          {"crs", web_mercator},
          {"wellKnownScaleSet", "http://www.opengis.net/def/wkss/OGC/1.0/GoogleMapsCompatible"},
          {"links", links_json({{"self", fmt::format("{}/ogc/tileMatrixSets/{}", origin, web_mercator_quad)}})},
          {"tileMatrices", std::move(matrices)},
          {"tileMatrix", std::move(matrices_of_1_0)}};
}

Json tile_json(map::LiveMap const& map, map::GridKey const& key, std::string const& origin) {
  auto const& grid = map.grids().at(key).grid;
  auto const& site = *map.site(key.site);
  Json json{{"tilejson", "3.0.0"},
            {"name", title_of(key)},
            {"scheme", "xyz"},
            {"tiles", Json::array({pictures_address(origin, key)})},
            {"minzoom", map::lowest_zoom},
            {"maxzoom", finest_zoom(grid, site)}};
  if (auto const box = grid_bounds(grid, site))
    json["bounds"] = {rounded(box->west, 7), rounded(box->south, 7), rounded(box->east, 7), rounded(box->north, 7)};
  return json;
}

}  // namespace lapwing::station
