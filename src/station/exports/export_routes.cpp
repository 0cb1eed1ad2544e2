#include "station/exports/export_routes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "station/messages/feed_json.hpp"
#include "station/messages/request_reader.hpp"

namespace lapwing::station {

namespace {

using Formats = std::vector<ExportFormat>;
constexpr std::size_t most_name_bytes = 200;

base::Error nobody_writes() {
  return {.kind = base::ErrorKind::not_found,
          .message = "This station keeps no map that could be exported.",
          .hint = "Start it with --store FOLDER."};
}

HttpResponse unknown() {
  return problem(404, "There is no such export any more.", "Files are kept for ten minutes: POST /api/v1/exports.");
}

HttpResponse list(base::Result<Formats> const& formats) {
  Json list = Json::array();
  for (auto const& format : formats ? *formats : Formats())
    list.push_back({{"name", format.name},
                    {"extension", format.extension},
                    {"features", format.holds_features},
                    {"grids", format.holds_grids},
                    {"pictures", format.holds_pictures},
                    {"note", format.note}});
  Json body{{"available", formats.has_value()}, {"formats", std::move(list)}};
  if (!formats) body.update({{"reason", formats.error().message}, {"hint", formats.error().hint}});
  return {.body = dump(body)};
}

base::Task<HttpResponse> ask_formats(MapExporter& exporter) {
  auto const formats = co_await exporter.formats();
  co_return list(formats);
}

Json job_json(ExportJobs::Job const& job) {
  auto const state = !job.outcome ? "running" : *job.outcome ? "done" : "failed";
  Json json{{"id", job.id}, {"state", state}, {"progress", rounded(job.progress, 3)}, {"name", job.name}};
  if (job.outcome && *job.outcome) json["bytes"] = **job.outcome;
  if (job.outcome && !*job.outcome)
    json.update({{"reason", job.outcome->error().message}, {"hint", job.outcome->error().hint}});
  return json;
}

/// West, south, east, north; one that crosses the antimeridian has its west east of its east.
std::optional<std::array<double, 4>> box_in(internal::RequestReader& reader) {
  auto const* const value = reader.find("within_deg");
  if (!value) return std::nullopt;
  bool const is_list = value->is_array() && value->size() == 4 &&
                       std::ranges::all_of(*value, [](auto const& number) { return number.is_number(); });
  std::array<double, 4> box{};
  if (is_list)
    std::ranges::transform(*value, box.begin(), [](auto const& number) { return number.template get<double>(); });
  auto const [west, south, east, north] = box;
  bool const is_on_earth = is_list && std::abs(west) <= 180.0 && std::abs(east) <= 180.0 && south >= -90.0 &&
                           south <= north && north <= 90.0;
  if (is_on_earth) return box;
  reader.refuse("\"within_deg\" must be [west, south, east, north] in degrees");
  return std::nullopt;
}

std::vector<std::string> layers_in(internal::RequestReader& reader) {
  if (!reader.find("layers")) return {};
  return reader.texts("layers", map::all_layers.size(), most_name_bytes, "must be a list of names of layers");
}

base::Result<ExportWish> parse_wish(std::string_view body, map::LiveMap const& map) {
  internal::RequestReader reader(body);
  ExportWish wish{.format = reader.text("format"),
                  .layers = layers_in(reader),
                  .site = reader.text("site"),
                  .floor = reader.text("floor"),
                  .within_deg = box_in(reader),
                  .scale = reader.number("scale").value_or(100.0)};
  for (auto const& name : wish.layers)
    if (!map::layer_named(name)) reader.refuse(fmt::format("there is no layer \"{}\"", name));
  if (wish.scale < 1.0 || wish.scale > 10'000.0) reader.refuse("\"scale\" must be from 1 to 10000");
  auto const* const site = wish.site.empty() ? nullptr : map.site(wish.site);
  if (!wish.site.empty() && !site) reader.refuse(fmt::format("there is no site \"{}\"", wish.site));
  bool const is_floor = wish.floor.empty() || (site && std::ranges::find(site->floors(), wish.floor, &geo::Floor::id) !=
                                                           site->floors().end());
  if (!is_floor) reader.refuse(fmt::format("there is no floor \"{}\" in that site", wish.floor));
  return reader.result(std::move(wish));
}

base::Task<HttpResponse> begin(ExportJobs& jobs, ExportWish wish) {
  auto const formats = co_await jobs.exporter().formats();
  if (!formats) co_return problem(503, formats.error().message, formats.error().hint);
  auto const format = std::ranges::find(*formats, wish.format, &ExportFormat::name);
  if (format == formats->end())
    co_return problem(400, fmt::format("There is no format \"{}\".", wish.format), "GET /api/v1/exports lists them.");
  auto const job = jobs.start(std::move(wish), format->extension);
  if (!job && job.error().kind == base::ErrorKind::refused) {
    auto busy = problem(429, job.error().message, job.error().hint);
    busy.headers.push_back({"Retry-After", "5"});
    co_return busy;
  }
  if (!job) co_return problem(job.error());
  HttpResponse response{.status = 202, .body = dump(job_json(*job))};
  response.headers.push_back({"Location", fmt::format("/api/v1/exports/{}", job->id)});
  co_return response;
}

std::string_view media_type_of(std::filesystem::path const& file) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> types{
      {{".gpkg", "application/geopackage+sqlite3"},
       {".kml", "application/vnd.google-earth.kml+xml"},
       {".kmz", "application/vnd.google-earth.kmz"},
       {".svg", "image/svg+xml"},
       {".pdf", "application/pdf"},
       {".zip", "application/zip"}}};
  auto const extension = file.extension().string();
  auto const found = std::ranges::find(types, extension, [](auto const& type) { return type.first; });
  return found == types.end() ? "application/octet-stream" : found->second;
}

base::Result<std::string> read(std::filesystem::path const& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  if (!in) return base::fail(base::ErrorKind::io, "The exported file cannot be read any more.", "Export it again.");
  return bytes;
}

base::Task<HttpResponse> hand_out(base::Loop& loop, std::filesystem::path file) {
  auto bytes = co_await loop.on_pool(read, file);
  if (!bytes) co_return problem(bytes.error());
  HttpResponse response{.content_type = std::string(media_type_of(file)), .body = *std::move(bytes)};
  // Its name is of letters, digits, '-' and '.'. What a program wrote is saved, never shown as a page of this
  // station's.
  response.headers.push_back(
      {"Content-Disposition", fmt::format("attachment; filename=\"{}\"", file.filename().string())});
  response.headers.push_back({"Cache-Control", "no-store"});
  co_return response;
}

}  // namespace

void add_export_routes(Router& router, base::Loop& loop, map::LiveMap const& map, ExportJobs* jobs) {
  constexpr auto const* one = "/api/v1/exports/{id}";
  router.add("GET", "/api/v1/exports", [jobs](HttpRequest const&) -> Reply {
    if (!jobs) return list(std::unexpected(nobody_writes()));
    return ask_formats(jobs->exporter());
  });
  router.add("POST", "/api/v1/exports", [jobs, &map](HttpRequest const& request) -> Reply {
    if (!jobs) return problem(503, nobody_writes().message, nobody_writes().hint);
    auto wish = parse_wish(request.body, map);
    if (!wish) return problem(wish.error());
    return begin(*jobs, *std::move(wish));
  });
  router.add("GET", one, [jobs](HttpRequest const&, PathArguments const& path) -> Reply {
    auto const* const job = jobs ? jobs->find(path["id"]) : nullptr;
    if (!job) return unknown();
    return HttpResponse{.body = dump(job_json(*job)), .headers = {{"Cache-Control", "no-store"}}};
  });
  router.add("DELETE", one, [jobs](HttpRequest const&, PathArguments const& path) -> Reply {
    if (!jobs || !jobs->drop(path["id"])) return unknown();
    return HttpResponse{204, "", "", {}};
  });
  router.add("GET", "/api/v1/exports/{id}/file", [jobs, &loop](HttpRequest const&, PathArguments const& path) -> Reply {
    auto const* const job = jobs ? jobs->find(path["id"]) : nullptr;
    if (!job) return unknown();
    if (!job->outcome) return problem(409, "This export still runs.", "GET its address until its state is \"done\".");
    if (!*job->outcome) return problem(job->outcome->error());
    return hand_out(loop, jobs->file_of(*job));
  });
}

}  // namespace lapwing::station
