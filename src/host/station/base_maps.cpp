#include "host/station/base_maps.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

namespace fs = std::filesystem;
using base::ConfigReader;
using base::ErrorKind;
using base::fail;

constexpr auto tiles_example = "https://tiles.example/{z}/{x}/{y}.png";

/// Of a name of any letters what may stand in an address; never twice the same.
std::string unique_id(std::string_view name, std::vector<station::BaseMap> const& others) {
  std::string id;
  for (char const c : name) {
    bool const is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
    id.push_back(is_plain ? c : '-');
  }
  auto const is_taken = [&](std::string const& one) {
    return std::ranges::find(others, one, &station::BaseMap::id) != others.end();
  };
  auto unique = id;
  for (int i = 2; is_taken(unique); ++i) unique = fmt::format("{}-{}", id, i);
  return unique;
}

base::Result<station::BaseMap> wanted(ConfigReader& base_map, fs::path const& beside, base::Span& span) {
  auto const file = base_map.text("file");
  auto const tiles = base_map.text("tiles");
  if (file) span = file->span;
  if (tiles) span = tiles->span;
  if (file.has_value() == tiles.has_value())
    return fail(ErrorKind::invalid_input, "a base map is a `file` or an address of `tiles`",
                fmt::format("file = \"yard.mbtiles\" or tiles = \"{}\"", tiles_example));
  if (file) return base_map_of(beside / file->value);
  if (auto const checked = check_tiles(tiles->value); !checked) return std::unexpected(checked.error());
  return remote_base_map(tiles->value);
}

}  // namespace

base::Result<> check_tiles(std::string const& address) {
  for (auto const* part : {"{z}", "{x}", "{y}"}) {
    if (!address.contains(part))
      return fail(ErrorKind::invalid_input, fmt::format("the address of map tiles must contain {}", part),
                  tiles_example);
  }
  for (auto const* start : {"https://", "http://127.0.0.1:", "http://localhost:"}) {
    if (address.starts_with(start)) return {};
  }
  return fail(ErrorKind::invalid_input, "map tiles must come over https:// or from this machine",
              fmt::format("{} or http://127.0.0.1:PORT/{{z}}/{{x}}/{{y}}.png", tiles_example));
}

station::BaseMap remote_base_map(std::string const& address) {
  auto const begin = address.find("//") + 2;
  auto const host = address.substr(begin, address.find('/', begin) - begin);
  return {.id = "tiles", .name = host, .source = station::TileAddressTemplate{address}};
}

base::Result<station::BaseMap> base_map_of(fs::path const& file) {
  auto const extension = file.extension();
  auto const name = file.stem().string();
  if (extension == ".tif" || extension == ".tiff")
    return fail(ErrorKind::invalid_input, fmt::format("{} is a picture, not map tiles yet", file.string()),
                fmt::format("make them once: lapwing basemap {}", file.string()));
  if (extension == ".geojson" || extension == ".json") {
    if (!fs::is_regular_file(file))
      return fail(ErrorKind::not_found, fmt::format("there is no file {}", file.string()));
    return station::BaseMap{.id = name, .name = name, .source = station::DrawnGround{file}};
  }
  auto archive = map::TileArchive::open(file);
  if (!archive) return std::unexpected(archive.error());
  auto const& told = (*archive)->info().name;
  return station::BaseMap{.id = name, .name = told.empty() ? name : told, .source = *std::move(archive)};
}

std::vector<station::BaseMap> read_base_maps(ConfigReader& map, fs::path const& beside) {
  std::vector<station::BaseMap> all;
  for (auto& [reader, place] : map.tables("base")) {
    auto span = place;
    auto base_map = wanted(reader, beside, span);
    auto const name = reader.text("name");
    auto const attribution = reader.text("attribution");
    auto const zoom = reader.integer("max_zoom", 0, map::TileAddress::deepest_zoom);
    reader.refuse_unknown();
    if (!base_map) {
      reader.diagnostics().report(base::config_kinds::invalid_value, span, base_map.error().message,
                                  base_map.error().hint);
      continue;
    }
    if (name) base_map->name = name->value;
    if (attribution) base_map->attribution = attribution->value;
    if (auto* remote = std::get_if<station::TileAddressTemplate>(&base_map->source); remote && zoom)
      remote->greatest_zoom = static_cast<std::uint32_t>(zoom->value);
    base_map->id = unique_id(base_map->id, all);
    all.push_back(*std::move(base_map));
  }
  return all;
}

}  // namespace lapwing::host
