#include "station/map/grids/grid_routes.hpp"

#include <charconv>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "station/map/features/feature_documents.hpp"
#include "station/map/grids/grid_json.hpp"
#include "station/map/ogc/ogc_documents.hpp"
#include "station/past/moment_words.hpp"

namespace lapwing::station {

using map::LiveMap;

namespace {

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
  auto key = grid_key_of(arguments);
  if (!map.grids().contains(key)) return no_grid(key);
  auto const tile = tile_address(arguments["z"], arguments["x"], arguments["y"]);
  if (!tile) return no_tile();
  auto const tag = fmt::format("\"{}-{}\"", run, pictures.revision_of(key, *tile));
  std::vector<HttpHeader> headers{
      {"ETag", tag},
      {"Cache-Control", may_be_kept(request, map, run) ? "private, max-age=31536000, immutable" : "private, no-cache"}};
  if (request.header("If-None-Match") == tag) return HttpResponse{304, "", "", std::move(headers)};
  return draw(pictures, std::move(key), *tile, std::move(headers));
}

base::Task<HttpResponse> draw_past(base::Loop& loop, PastGrids& past, Moment moment, map::GridKey key,
                                   map::XyzTile tile, HttpRequest request) {
  bool const is_settled = moment.at + std::chrono::seconds(10) < loop.utc_now();
  auto picture = co_await past.picture(std::move(moment), std::move(key), tile);
  if (!picture) co_return problem(picture.error());
  co_return picture_of_the_past(request, *std::move(picture), is_settled);
}

Reply get_past_picture(base::Loop& loop, PastGrids* past, HttpRequest const& request, PathArguments const& arguments) {
  if (!past) return no_history();
  auto const at = time_parameter(request, "at_ms");
  if (!at) return problem(at.error());
  auto session = request.parameter("session");
  if (!session) return problem(400, "The parameter \"session\" is missing.", "See /api/v1/history.");
  auto const tile = tile_address(arguments["z"], arguments["x"], arguments["y"]);
  if (!tile) return no_tile();
  return draw_past(loop, *past, {*std::move(session), *at}, grid_key_of(arguments), *tile, request);
}

}  // namespace

map::GridKey grid_key_of(PathArguments const& arguments) {
  auto const& floor = arguments["floor"];
  return {arguments["site"], floor == "-" ? "" : floor, arguments["name"]};
}

HttpResponse no_tile() {
  return problem(404, "There is no such tile.",
                 fmt::format("z is at most {}, x and y are below 2^z.", map::highest_zoom));
}

void add_grid_routes(Router& router, base::Loop& loop, LiveMap const& map, GridPictures& pictures, PastGrids* past,
                     std::string run) {
  router.add("GET", "/api/v1/grids", [&map, run](HttpRequest const&) { return get_grids(map, run); });
  router.add("GET", "/api/v1/grids/{site}/{floor}/{name}/tiles.json",
             [&map](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               auto const key = grid_key_of(arguments);
               if (!map.grids().contains(key)) return no_grid(key);
               return HttpResponse{.body = dump(tile_json(map, key, origin_of(request)))};
             });
  router.add("GET", "/api/v1/grids/{site}/{floor}/{name}/tiles/{z}/{x}/{y}.png",
             [&loop, &map, &pictures, past, run](HttpRequest const& request, PathArguments const& arguments) -> Reply {
               if (request.parameter("at_ms")) return get_past_picture(loop, past, request, arguments);
               return get_picture(map, pictures, run, request, arguments);
             });
}

}  // namespace lapwing::station
