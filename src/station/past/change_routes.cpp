#include "station/past/change_routes.hpp"

#include <chrono>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "map/features/placement.hpp"
#include "station/map/grids/grid_json.hpp"
#include "station/map/grids/grid_routes.hpp"
#include "station/map/grids/web_mercator.hpp"
#include "station/messages/feed_json.hpp"
#include "station/past/feature_changes.hpp"
#include "station/past/moment_words.hpp"

namespace lapwing::station {

namespace {

using namespace std::chrono_literals;
using map::Store;

/// More than anybody reads, and less than makes a page slow.
constexpr std::size_t most_features = 2000;

struct Span {
  Moment from;
  Moment to;
};

base::Result<Span> span_of(HttpRequest const& request, std::string const& session) {
  auto const from = time_parameter(request, "from_ms");
  if (!from) return std::unexpected(from.error());
  auto const to = time_parameter(request, "to_ms");
  if (!to) return std::unexpected(to.error());
  return Span{{session, *from}, {request.parameter("to_session").value_or(session), *to}};
}

std::string pictures_of(Span const& span, map::GridKey const& key) {
  return fmt::format("/api/v1/history/{}/changes/{}/{}/{}/{{z}}/{{x}}/{{y}}.png?from_ms={}&to_session={}&to_ms={}",
                     percent_encoded(span.from.session), percent_encoded(key.site),
                     key.floor.empty() ? "-" : percent_encoded(key.floor), percent_encoded(key.name),
                     milliseconds_of(span.from.at), percent_encoded(span.to.session), milliseconds_of(span.to.at));
}

/// Round the tiles that have changed, on the globe.
Json bounds_of(PastGrids::Difference const& difference, geo::Site const& site) {
  map::OccupancyGrid outline(difference.place.resolution_m, difference.place.site_from_grid);
  auto const nothing = std::make_shared<map::GridTile>();
  for (auto const& tile : difference.tiles) outline.set_tile(tile, nothing);
  auto const box = grid_bounds(outline, site);
  return {rounded(box->west, 7), rounded(box->south, 7), rounded(box->east, 7), rounded(box->north, 7)};
}

Json grids_json(std::vector<PastGrids::Difference> const& differences, Span const& span) {
  Json grids = Json::array();
  for (auto const& difference : differences) {
    auto const site = geo::Site::make(difference.key.site, difference.place.anchor);
    if (!site) continue;
    grids.push_back({{"site", difference.key.site},
                     {"floor", difference.key.floor},
                     {"name", difference.key.name},
                     {"anew", difference.is_anew},
                     {"taken", difference.taken},
                     {"freed", difference.freed},
                     {"other", difference.other},
                     {"bounds", bounds_of(difference, *site)},
                     {"pictures", pictures_of(span, difference.key)}});
  }
  return grids;
}

base::Task<HttpResponse> compare(base::Loop& loop, Store& store, PastGrids& grids, Span span) {
  auto before = co_await store.state_at(span.from.session, span.from.at);
  if (!before) co_return problem(before.error());
  auto after = co_await store.state_at(span.to.session, span.to.at);
  if (!after) co_return problem(after.error());
  auto const features = co_await loop.on_pool(feature_changes, *std::move(before), *std::move(after), most_features);
  auto const differences = co_await grids.compare(span.from, span.to);
  if (!differences) co_return problem(differences.error());
  co_return HttpResponse{.body = fmt::format(R"({{"from_ms":{},"to_ms":{},"layers":{},"left_out":{},"grids":{}}})",
                                             milliseconds_of(span.from.at), milliseconds_of(span.to.at),
                                             features.layers, features.left_out, dump(grids_json(*differences, span)))};
}

base::Task<HttpResponse> draw(base::Loop& loop, PastGrids& grids, Span span, map::GridKey key, map::XyzTile tile,
                              HttpRequest request) {
  bool const is_settled = std::max(span.from.at, span.to.at) + 10s < loop.utc_now();
  auto picture = co_await grids.changes(std::move(span.from), std::move(span.to), std::move(key), tile);
  if (!picture) co_return problem(picture.error());
  co_return picture_of_the_past(request, *std::move(picture), is_settled);
}

}  // namespace

void add_change_routes(Router& router, base::Loop& loop, Store* store, PastGrids* grids) {
  router.add("GET", "/api/v1/history/{session}/changes",
             [&loop, store, grids](HttpRequest const& request, PathArguments const& path) -> Reply {
               if (!store) return no_history();
               auto span = span_of(request, path["session"]);
               if (!span) return problem(span.error());
               return compare(loop, *store, *grids, *std::move(span));
             });
  router.add("GET", "/api/v1/history/{session}/changes/{site}/{floor}/{name}/{z}/{x}/{y}.png",
             [&loop, grids](HttpRequest const& request, PathArguments const& path) -> Reply {
               if (!grids) return no_history();
               auto span = span_of(request, path["session"]);
               if (!span) return problem(span.error());
               auto const tile = tile_address(path["z"], path["x"], path["y"]);
               if (!tile) return no_tile();
               return draw(loop, *grids, *std::move(span), grid_key_of(path), *tile, request);
             });
}

}  // namespace lapwing::station
