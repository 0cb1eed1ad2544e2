#include "station/map/grids/grid_routes.hpp"

#include <charconv>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "station/map/features/feature_documents.hpp"
#include "station/map/grids/grid_json.hpp"
#include "station/map/ogc/ogc_documents.hpp"

namespace lapwing::station {

using map::LiveMap;

namespace {

/// The grid that a path names; "-" is the site's ground.
map::GridKey key_of(PathArguments const& arguments) {
  auto const& floor = arguments["floor"];
  return {arguments["site"], floor == "-" ? "" : floor, arguments["name"]};
}

HttpResponse no_grid(map::GridKey const& key) {
  return problem(404,
                 fmt::format("There is no grid \"{}\" on floor \"{}\" of site \"{}\".", key.name, key.floor, key.site),
                 "See /api/v1/grids.");
}

HttpResponse get_grids(LiveMap const& map, std::string_view run) {
  Json grids = Json::array();
  for (auto const& [key, record] : map.grids()) {
    auto json = grid_json(key, record, *map.site(key.site));
    json["revision"] = record.revision;
    json["pictures"] = grid_pictures(key, run, record.revision);
    grids.push_back(std::move(json));
  }
  return {.body = dump({{"grids", std::move(grids)}})};
}

/// Whether an address names a revision of this run that there has been: what is under it may be kept.
bool may_be_kept(HttpRequest const& request, LiveMap const& map, std::string_view run) {
  auto const asked = request.parameter("revision").value_or("");
  auto const dash = asked.rfind('-');
  if (dash == std::string::npos || asked.substr(0, dash) != run) return false;
  map::Revision revision = 0;
  auto const [end, error] = std::from_chars(asked.data() + dash + 1, asked.data() + asked.size(), revision);
  return error == std::errc{} && end == asked.data() + asked.size() && revision <= map.revision();
}

base::Task<HttpResponse> draw(GridPictures& pictures, map::GridKey key, map::XyzTile tile,
                              std::vector<HttpHeader> headers) {
  auto const png = co_await pictures.picture(std::move(key), tile);
  co_return HttpResponse{200, "image/png", *png, std::move(headers)};
}

Reply get_picture(LiveMap const& map, GridPictures& pictures, std::string const& run, HttpRequest const& request,
                  PathArguments const& arguments) {
  auto key = key_of(arguments);
  if (!map.grids().contains(key)) return no_grid(key);
  auto const tile = tile_address(arguments["z"], arguments["x"], arguments["y"]);
  if (!tile)
    return problem(404, "There is no such tile.",
                   fmt::format("z is at most {}, x and y are below 2^z.", map::highest_zoom));
  auto const tag = fmt::format("\"{}-{}\"", run, pictures.revision_of(key, *tile));
  std::vector<HttpHeader> headers{
      {"ETag", tag},
      {"Cache-Control", may_be_kept(request, map, run) ? "private, max-age=31536000, immutable" : "private, no-cache"}};
  if (request.header("If-None-Match") == tag) return HttpResponse{304, "", "", std::move(headers)};
  return draw(pictures, std::move(key), *tile, std::move(headers));
}

}  // namespace

void add_grid_routes(Router& router, LiveMap const& map, GridPictures& pictures, std::string run) {
  router.add("GET", "/api/v1/grids", [&map, run](HttpRequest const&) { return get_grids(map, run); });
  router.add("GET", "/api/v1/grids/{site}/{floor}/{name}/tiles.json",
             [&map](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               auto const key = key_of(arguments);
               if (!map.grids().contains(key)) return no_grid(key);
               return HttpResponse{.body = dump(tile_json(map, key, origin_of(request)))};
             });
  router.add("GET", "/api/v1/grids/{site}/{floor}/{name}/tiles/{z}/{x}/{y}.png",
             [&map, &pictures, run](HttpRequest const& request, PathArguments const& arguments) {
               return get_picture(map, pictures, run, request, arguments);
             });
}

}  // namespace lapwing::station
