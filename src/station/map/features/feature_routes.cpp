#include "station/map/features/feature_routes.hpp"

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "map/features/feature_json.hpp"
#include "station/map/features/feature_documents.hpp"
#include "station/map/features/feature_query.hpp"
#include "station/messages/control_messages.hpp"

namespace lapwing::station {

using map::LayerKind;
using map::LiveMap;

namespace {

HttpResponse no_layer(std::string_view name) {
  std::string known;
  for (auto const layer : map::all_layers) known += fmt::format("{}{}", known.empty() ? "" : ", ", map::name_of(layer));
  return problem(404, fmt::format("There is no layer \"{}\".", name), fmt::format("There are {}.", known));
}

HttpResponse no_feature(LayerKind layer, std::string_view id) {
  return problem(404, fmt::format("There is no feature \"{}\" in {}.", id, map::name_of(layer)));
}

/// Null when there is none, or it has been removed.
map::FeatureRecord const* find(LiveMap const& map, LayerKind layer, std::string const& id) {
  auto const* const record = map.find(layer, id);
  return record && !record->is_removed ? record : nullptr;
}

HttpResponse show(LiveMap const& map, map::FeatureRecord const& record, int status = 200) {
  HttpResponse response{.status = status,
                        .content_type = std::string(geojson_type),
                        .body = dump(map::feature_json(record.feature, *map.site(record.feature.site)))};
  response.headers.push_back({"ETag", feature_tag(map, record)});
  response.headers.push_back({"Cache-Control", "no-cache"});
  return response;
}

HttpResponse get_layers(LiveMap const& map) {
  Json layers = Json::array();
  for (auto const layer : map::all_layers) {
    auto const name = map::name_of(layer);
    layers.push_back({{"name", name}, {"features", map.size(layer)}, {"feed", fmt::format("map.{}", name)}});
  }
  return {.body = dump({{"layers", std::move(layers)}})};
}

Reply get_features(base::Loop& loop, LiveMap const& map, LayerKind layer, HttpRequest const& request) {
  auto const query = feature_query(layer, request);
  if (!query) return problem(query.error());
  return feature_collection(loop, map, request, *query, {});
}

HttpResponse get_feature(LiveMap const& map, LayerKind layer, std::string const& id, HttpRequest const& request) {
  auto const* const record = find(map, layer, id);
  if (!record) return no_feature(layer, id);
  if (request.header("If-None-Match") == feature_tag(map, *record)) return {304, "", "", {}};
  return show(map, *record);
}

// ---- what changes the map

/// Under which a client wants a feature to be changed only.
struct Preconditions {
  std::string match;  ///< its tag, "*" for any, or empty
  bool must_be_new = false;

  explicit Preconditions(HttpRequest const& request)
      : match(request.header("If-Match")), must_be_new(request.header("If-None-Match") == "*") {}

  /// Nothing when they hold; `record` is null where there is none.
  [[nodiscard]] std::optional<HttpResponse> failure(LiveMap const& map, map::FeatureRecord const* record) const {
    if (!match.empty() && (!record || (match != "*" && match != feature_tag(map, *record))))
      return problem(412, "The feature is not what If-Match says it is.", "Get it anew, and decide again.");
    if (must_be_new && record)
      return problem(412, "There is such a feature already.", "Leave out If-None-Match to write over it.");
    return std::nullopt;
  }
};

/// What stands for what a body leaves out. A value, as it goes to another thread.
struct Source {
  LayerKind layer = LayerKind::slots;
  std::map<std::string, geo::Site, std::less<>> sites;
  map::FeatureDefaults defaults;
};

Source source_of(base::Loop const& loop, LiveMap const& map, LayerKind layer, HttpRequest const& request) {
  auto site = request.parameter("site").value_or("");
  if (site.empty() && map.sites().size() == 1) site = map.sites().begin()->first;
  return {.layer = layer,
          .sites = map.sites(),
          .defaults = {.site = std::move(site),
                       .floor = request.parameter("floor").value_or(""),
                       .account = {request.parameter("writer").value_or(std::string(unnamed_client)), loop.utc_now()}}};
}

base::Result<std::vector<map::Feature>> read(std::string const& body, Source const& source) {
  auto const find_site = [&source](std::string_view id) -> geo::Site const* {
    auto const found = source.sites.find(id);
    return found == source.sites.end() ? nullptr : &found->second;
  };
  return map::read_features(body, source.layer, find_site, source.defaults);
}

/// A site that is not known is a mistake of the body, not of the address.
HttpResponse fault_of(base::Error const& error) {
  return error.kind == base::ErrorKind::not_found ? problem(422, error.message, error.hint) : problem(error);
}

HttpResponse put_one(LiveMap& map, LayerKind layer, map::Feature feature, Preconditions const& preconditions) {
  auto const id = feature.id;
  auto const* const before = find(map, layer, id);
  if (auto failure = preconditions.failure(map, before)) return *std::move(failure);
  bool const is_new = !before;
  auto const put = map.put(feature);
  if (!put) return fault_of(put.error());
  auto const* const after = find(map, layer, id);
  // Who says again what the map has from him already has his way.
  bool const is_so = *put == LiveMap::Outcome::changed || (after && after->feature == feature);
  if (!is_so || !after)
    return problem(409, "What the map knows of it is newer.", "Give a later \"at\", or leave it out: then it is now.");
  return show(map, *after, is_new ? 201 : 200);
}

// A long body takes longer to read than the loop may stand still.

base::Task<HttpResponse> put_feature(base::Loop& loop, LiveMap& map, std::string body, Source source,
                                     Preconditions preconditions) {
  auto const layer = source.layer;
  auto const id = source.defaults.id;
  auto features = co_await loop.on_pool(read, std::move(body), std::move(source));
  if (!features) co_return fault_of(features.error());
  if (features->size() != 1) co_return problem(400, "The body must be one Feature.");
  if (features->front().id != id)
    co_return problem(400, "The feature's id is another than that of the address.", "Leave it out.");
  co_return put_one(map, layer, std::move(features->front()), preconditions);
}

base::Task<HttpResponse> post_features(base::Loop& loop, LiveMap& map, std::string body, Source source) {
  auto features = co_await loop.on_pool(read, std::move(body), std::move(source));
  if (!features) co_return fault_of(features.error());
  auto const given = features->size();
  auto const changed = map.put_all(*std::move(features));
  if (!changed) co_return fault_of(changed.error());
  Json const counts{{"given", given}, {"changed", *changed}};
  co_return HttpResponse{.body = dump(counts)};
}

HttpResponse delete_feature(base::Loop const& loop, LiveMap& map, LayerKind layer, std::string const& id,
                            HttpRequest const& request) {
  auto const* const record = find(map, layer, id);
  if (!record) return no_feature(layer, id);
  if (auto failure = Preconditions(request).failure(map, record)) return *std::move(failure);
  auto writer = request.parameter("writer").value_or(std::string(unnamed_client));
  auto const removed = map.remove(layer, id, {std::move(writer), loop.utc_now()});
  if (!removed) return problem(removed.error());
  if (*removed == LiveMap::Outcome::outdated) return problem(409, "What the map knows of it is newer than now.");
  return {204, "", "", {}};
}

}  // namespace

void add_feature_routes(Router& router, base::Loop& loop, LiveMap& map) {
  auto const add = [&router](std::string method, std::string path, auto answer,
                             std::optional<std::size_t> max_body_bytes = {}) {
    router.add(
        std::move(method), std::move(path),
        [answer](HttpRequest const& request, PathArguments const& arguments) -> Reply {
          auto const layer = map::layer_named(arguments["layer"]);
          if (!layer) return no_layer(arguments["layer"]);
          return answer(*layer, request, arguments);
        },
        max_body_bytes);
  };
  using Request = HttpRequest const&;
  using Arguments = PathArguments const&;
  std::string const all = "/api/v1/layers/{layer}/features";
  auto const one = all + "/{id}";
  router.add("GET", "/api/v1/layers", [&map](Request) { return get_layers(map); });
  add("GET", all, [&loop, &map](LayerKind layer, Request request, Arguments) -> Reply {
    return get_features(loop, map, layer, request);
  });
  add("GET", one, [&map](LayerKind layer, Request request, Arguments arguments) -> Reply {
    return get_feature(map, layer, arguments["id"], request);
  });
  add(
      "POST", all,
      [&loop, &map](LayerKind layer, Request request, Arguments) -> Reply {
        return post_features(loop, map, request.body, source_of(loop, map, layer, request));
      },
      map::most_json_bytes);
  add(
      "PUT", one,
      [&loop, &map](LayerKind layer, Request request, Arguments arguments) -> Reply {
        auto source = source_of(loop, map, layer, request);
        source.defaults.id = arguments["id"];
        return put_feature(loop, map, request.body, std::move(source), Preconditions(request));
      },
      map::most_json_bytes);
  add("DELETE", one, [&loop, &map](LayerKind layer, Request request, Arguments arguments) -> Reply {
    return delete_feature(loop, map, layer, arguments["id"], request);
  });
}

}  // namespace lapwing::station
