#include "station/map/ogc/ogc_routes.hpp"

#include <functional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "map/features/feature_json.hpp"
#include "station/map/features/feature_documents.hpp"
#include "station/map/features/feature_query.hpp"
#include "station/map/ogc/ogc_api_document.hpp"
#include "station/map/ogc/ogc_documents.hpp"

namespace lapwing::station {

using map::LiveMap;

namespace {

HttpResponse answer(Json const& json, std::string_view type = "application/json") {
  return {.content_type = std::string(type), .body = dump(json)};
}

HttpResponse no_collection(std::string_view name) {
  return problem(404, fmt::format("There is no collection \"{}\".", name), "See /ogc/collections.");
}

/// These take no parameters but the format, of which there is one; others are mistakes (Features 1.0, requirement 8).
std::optional<HttpResponse> parameter_fault(HttpRequest const& request) {
  auto const parameters = request.parameters();
  if (!parameters) return problem(400, "The address is badly encoded.");
  for (auto const& [name, value] : *parameters)
    if (name != "f" || value != "json") return problem(400, fmt::format("There is no parameter \"{}\" here.", name));
  return std::nullopt;
}

Reply get_item(LiveMap const& map, map::LayerKind layer, std::string const& id, HttpRequest const& request) {
  auto const* const record = map.find(layer, id);
  if (!record || record->is_removed)
    return problem(404, fmt::format("There is no feature \"{}\" in {}.", id, map::name_of(layer)));
  auto json = map::feature_json(record->feature, *map.site(record->feature.site));
  auto const collection = fmt::format("{}/ogc/collections/{}", origin_of(request), map::name_of(layer));
  json["links"] = links_json({{"self", address_of(request), geojson_type}, {"collection", collection}});
  auto response = answer(json, geojson_type);
  response.headers.push_back({"ETag", feature_tag(map, *record)});
  return response;
}

Reply get_items(base::Loop& loop, LiveMap const& map, map::LayerKind layer, HttpRequest const& request) {
  auto const query = feature_query(layer, request);
  if (!query) return problem(query.error());
  auto const collection = fmt::format("{}/ogc/collections/{}", origin_of(request), map::name_of(layer));
  return feature_collection(loop, map, request, *query, {{"collection", collection}});
}

/// One that does not depend on what its path names.
void add_document(Router& router, std::string path, std::function<Json(HttpRequest const&)> write,
                  std::string_view type = "application/json") {
  router.add("GET", std::move(path), [write = std::move(write), type](HttpRequest const& request) -> Reply {
    if (auto fault = parameter_fault(request)) return *std::move(fault);
    return answer(write(request), type);
  });
}

void add_grid_document(Router& router, LiveMap const& map, std::string path,
                       Json (*write)(LiveMap const&, map::GridKey const&, std::string const&)) {
  router.add("GET", std::move(path),
             [&map, write](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               if (auto fault = parameter_fault(request)) return *std::move(fault);
               map::GridKey key;
               if (!grid_of_collection(map, arguments["collection"], key))
                 return no_collection(arguments["collection"]);
               return answer(write(map, key, origin_of(request)));
             });
}

Reply get_collection(LiveMap const& map, std::string const& name, HttpRequest const& request) {
  if (auto fault = parameter_fault(request)) return *std::move(fault);
  if (auto const layer = map::layer_named(name)) return answer(ogc_layer(map, *layer, origin_of(request)));
  map::GridKey key;
  if (grid_of_collection(map, name, key)) return answer(ogc_grid(map, key, origin_of(request)));
  return no_collection(name);
}

}  // namespace

void add_ogc_routes(Router& router, base::Loop& loop, LiveMap const& map) {
  add_document(router, "/ogc", [](auto const& request) { return ogc_landing_page(origin_of(request)); });
  add_document(router, "/ogc/conformance", [](auto const&) { return ogc_conformance(); });
  add_document(
      router, "/ogc/api", [](auto const& request) { return ogc_api_document(origin_of(request)); },
      "application/vnd.oai.openapi+json;version=3.0");
  add_document(router, "/ogc/collections",
               [&map](auto const& request) { return ogc_collections(map, origin_of(request)); });
  router.add("GET", "/ogc/collections/{collection}",
             [&map](HttpRequest const& request, PathArguments const& arguments) {
               return get_collection(map, arguments["collection"], request);
             });
  router.add("GET", "/ogc/collections/{collection}/items",
             [&loop, &map](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               auto const layer = map::layer_named(arguments["collection"]);
               if (!layer) return no_collection(arguments["collection"]);
               return get_items(loop, map, *layer, request);
             });
  router.add("GET", "/ogc/collections/{collection}/items/{id}",
             [&map](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               if (auto fault = parameter_fault(request)) return *std::move(fault);
               auto const layer = map::layer_named(arguments["collection"]);
               if (!layer) return no_collection(arguments["collection"]);
               return get_item(map, *layer, arguments["id"], request);
             });
  add_grid_document(router, map, "/ogc/collections/{collection}/map/tiles", ogc_tilesets);
  add_grid_document(router, map, "/ogc/collections/{collection}/map/tiles/WebMercatorQuad", ogc_tileset);
  add_document(router, "/ogc/tileMatrixSets", [](auto const& request) {
    auto const quad = ogc_web_mercator_quad(origin_of(request));
    return Json{
        {"tileMatrixSets",
         Json::array(
             {{{"id", quad["id"]}, {"title", quad["title"]}, {"uri", quad["uri"]}, {"links", quad["links"]}}})}};
  });
  add_document(router, "/ogc/tileMatrixSets/WebMercatorQuad",
               [](auto const& request) { return ogc_web_mercator_quad(origin_of(request)); });
}

}  // namespace lapwing::station
