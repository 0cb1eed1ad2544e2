#include "station/basemaps/base_map_routes.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

using Archive = std::shared_ptr<map::TileArchive const>;

constexpr std::uintmax_t most_drawing_bytes = std::uintmax_t{16} * 1024 * 1024;

/// How a map shows it, by what it is.
struct Source {
  BaseMap const& of;

  Json operator()(TileAddressTemplate const& remote) const {
    return {{"kind", "tiles"}, {"url", remote.url}, {"max_zoom", remote.greatest_zoom}};
  }
  Json operator()(Archive const& archive) const {
    auto const& info = archive->info();
    Json json{{"kind", info.media_type == "application/x-protobuf" ? "vector_tiles" : "tiles"},
              {"url", fmt::format("/api/v1/basemaps/{}/tiles/{{z}}/{{x}}/{{y}}", of.id)},
              {"min_zoom", info.least_zoom},
              {"max_zoom", info.greatest_zoom},
              {"bounds_deg", info.bounds_deg}};
    if (!info.vector_layers.empty()) json["vector_layers"] = info.vector_layers;
    return json;
  }
  Json operator()(DrawnGround const&) const {
    return {{"kind", "drawing"}, {"url", fmt::format("/api/v1/basemaps/{}/drawing", of.id)}};
  }
};

std::string attribution_of(BaseMap const& base_map) {
  if (!base_map.attribution.empty()) return base_map.attribution;
  auto const* archive = std::get_if<Archive>(&base_map.source);
  return archive ? (*archive)->info().attribution : std::string();
}

HttpResponse list(std::vector<BaseMap> const& maps) {
  Json all = Json::array();
  for (auto const& base_map : maps) {
    Json one{{"id", base_map.id}, {"name", base_map.name}, {"attribution", attribution_of(base_map)}};
    one.update(std::visit(Source{base_map}, base_map.source));
    all.push_back(std::move(one));
  }
  return {.body = dump({{"basemaps", std::move(all)}})};
}

std::optional<map::TileAddress> address_in(PathArguments const& path) {
  auto const number = [&](std::string_view name) {
    auto const& text = path[name];
    std::uint32_t value = 0;
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
  };
  auto const zoom = number("z");
  auto const x = number("x");
  auto const y = number("y");
  if (!zoom || !x || !y) return std::nullopt;
  map::TileAddress const address{*zoom, *x, *y};
  return address.is_valid() ? std::optional(address) : std::nullopt;
}

base::Task<HttpResponse> tile(base::Loop& loop, Archive archive, map::TileAddress address) {
  auto found =
      co_await loop.on_pool([](Archive const& from, map::TileAddress at) { return from->tile(at); }, archive, address);
  if (!found) co_return problem(found.error());
  // An archive stays as it is while the station runs, so a browser need not ask again within the hour.
  HttpHeader const caching{"Cache-Control", "private, max-age=3600"};
  if (!*found) co_return HttpResponse{.status = 204, .headers = {caching}};
  HttpResponse response{.content_type = archive->info().media_type, .body = **std::move(found), .headers = {caching}};
  if (!archive->info().encoding.empty()) response.headers.push_back({"Content-Encoding", archive->info().encoding});
  co_return response;
}

base::Result<std::string> read_drawing(std::filesystem::path const& file) {
  std::error_code error;
  auto const size = std::filesystem::file_size(file, error);
  if (error)
    return base::fail(base::ErrorKind::not_found,
                      fmt::format("The drawing {} is gone: {}.", file.filename().string(), error.message()));
  if (size > most_drawing_bytes)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("The drawing {} is larger than 16 MiB.", file.filename().string()));
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in)
    return base::fail(base::ErrorKind::io, fmt::format("The drawing {} cannot be read.", file.filename().string()));
  return text;
}

base::Task<HttpResponse> drawing(base::Loop& loop, std::filesystem::path file) {
  auto text = co_await loop.on_pool(read_drawing, std::move(file));
  if (!text) co_return problem(text.error());
  co_return HttpResponse{.content_type = "application/geo+json", .body = *std::move(text)};
}

HttpResponse unknown() {
  return problem(404, "There is no such base map here.", "GET /api/v1/basemaps lists them.");
}

}  // namespace

void add_base_map_routes(Router& router, base::Loop& loop, std::vector<BaseMap> const& given) {
  auto const maps = std::make_shared<std::vector<BaseMap> const>(given);
  auto const find = [maps](std::string_view id) -> BaseMap const* {
    auto const found = std::ranges::find(*maps, id, &BaseMap::id);
    return found == maps->end() ? nullptr : &*found;
  };
  router.add("GET", "/api/v1/basemaps", [maps](HttpRequest const&) { return list(*maps); });
  router.add("GET", "/api/v1/basemaps/{id}/tiles/{z}/{x}/{y}",
             [&loop, find](HttpRequest const&, PathArguments const& path) -> Reply {
               auto const* base_map = find(path["id"]);
               auto const* archive = base_map ? std::get_if<Archive>(&base_map->source) : nullptr;
               if (!archive) return unknown();
               auto const address = address_in(path);
               if (!address)
                 return problem(400, "That is no tile of the world.", "Tiles are {zoom}/{column}/{row}, zoom 0 to 26.");
               return tile(loop, *archive, *address);
             });
  router.add("GET", "/api/v1/basemaps/{id}/drawing",
             [&loop, find](HttpRequest const&, PathArguments const& path) -> Reply {
               auto const* base_map = find(path["id"]);
               auto const* ground = base_map ? std::get_if<DrawnGround>(&base_map->source) : nullptr;
               if (!ground) return unknown();
               return drawing(loop, ground->file);
             });
}

}  // namespace lapwing::station
