#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "apps/map/store_export.hpp"
#include "apps/verb.hpp"
#include "base/async/loop.hpp"
#include "formats/format.hpp"
#include "map/store/care/care.hpp"
#include "map/store/care/retention.hpp"
#include "map/store/store.hpp"

namespace lapwing::apps {

namespace {

namespace care = map::care;
using base::ErrorKind;
using base::fail;

struct StoreOptions {
  std::string store;
  std::string other;  ///< the copy; the file that is read
  std::string layer;
  std::string site;
  std::string floor;
  std::string writer = "import";
  std::optional<std::uint64_t> most_mb;
  std::optional<int> days;
};

std::string size_text(std::uint64_t bytes) {
  constexpr double kilo = 1000.0;
  double size = static_cast<double>(bytes);
  for (auto const* unit : {"B", "kB", "MB", "GB"}) {
    if (size < kilo) return fmt::format("{:.{}f} {}", size, std::string_view(unit) == "B" ? 0 : 1, unit);
    size /= kilo;
  }
  return fmt::format("{:.1f} TB", size);
}

int list(StoreOptions const& options) {
  auto const found = care::summary(options.store);
  if (!found) return host::refuse(found.error());
  fmt::print("{}, version {}\n", size_text(found->bytes), found->version);
  for (auto const& site : found->sites) fmt::print("site {}\n", site);
  for (auto const& [layer, count] : found->features) fmt::print("{:<20}{:>10}\n", map::name_of(layer), count);
  for (auto const& [key, tiles] : found->grid_tiles)
    fmt::print("grid {} {} {}: {} tiles\n", key.site, key.floor.empty() ? "-" : key.floor, key.name, tiles);
  fmt::print("{:<20}{:>10}\n", "past looks of tiles", found->tile_shades);
  fmt::print("{:<20}{:>10}  {}\n", "pictures kept", found->pictures, size_text(found->picture_bytes));
  fmt::print("{:<20}{:>10}\n", "sessions", found->sessions.size());
  return host::exit_done;
}

int verify(StoreOptions const& options) {
  auto const verdict = care::verify(options.store);
  if (!verdict) return host::refuse(verdict.error());
  for (auto const& fault : verdict->faults) fmt::print("{}\n", fault);
  if (verdict->stray_pictures > 0)
    fmt::print("{} pictures that nothing tells of were left by an interruption; compact takes them away\n",
               verdict->stray_pictures);
  fmt::print("{} things looked at, {} faults\n", verdict->looked_at, verdict->faults.size());
  return verdict->faults.empty() ? host::exit_done : host::exit_failed;
}

int compact(StoreOptions const& options) {
  care::Limits limits;
  if (options.most_mb) limits.most_bytes = *options.most_mb * 1024 * 1024;
  if (options.days) limits.longest = std::chrono::days(*options.days);
  auto const done = care::compact(options.store, limits);
  if (!done) return host::refuse(done.error());
  fmt::print("{} before, {} now\n", size_text(done->bytes_before), size_text(done->bytes_after));
  return host::exit_done;
}

int copy(StoreOptions const& options) {
  auto const copied = care::copy(options.store, options.other);
  if (!copied) return host::refuse(copied.error());
  for (auto const& fault : copied->faults) fmt::print("{}\n", fault);
  fmt::print("{} rows and {} pictures copied\n", copied->rows, copied->pictures);
  return copied->faults.empty() ? host::exit_done : host::exit_failed;
}

base::Result<std::optional<map::LayerKind>> layer_of(std::string const& name) {
  if (name.empty()) return std::optional<map::LayerKind>();
  auto const layer = layer_called(name);
  if (!layer) return std::unexpected(layer.error());
  return std::optional(*layer);
}

/// Where what names no site lies: the one that is asked for, else the only one.
base::Result<std::optional<geo::Site>> site_for(map::LiveMap const& map, std::string const& id) {
  if (!id.empty()) {
    auto const* site = map.site(id);
    if (!site) return fail(ErrorKind::not_found, fmt::format("the store has no site `{}`", id));
    return std::optional(*site);
  }
  return map.sites().size() == 1 ? std::optional(map.sites().begin()->second) : std::nullopt;
}

base::Result<std::size_t> put_into(map::LiveMap& map, formats::MapContents contents, std::string const& writer) {
  for (auto const& [id, site] : contents.sites) {
    if (!map.site(id)) map.put_site(site);
  }
  auto put = map.put_all(std::move(contents.features));
  if (!put) return put;
  map::Account const account{.writer = writer, .at = std::chrono::system_clock::now()};
  for (auto const& [key, grid] : contents.grids) {
    std::vector<map::TileKey> tiles;
    for (auto const& [at, tile] : grid.tiles()) tiles.push_back(at);
    if (auto const written = map.put_tiles(key, grid, tiles, account); !written)
      return std::unexpected(written.error());
    *put += 1;
  }
  return put;
}

base::Task<> import_into(map::Store& store, StoreOptions const& options, base::Result<std::size_t>& put) {
  map::LiveMap map([] { return std::chrono::system_clock::now(); });
  if (auto const loaded = co_await store.load(map); !loaded) {
    put = std::unexpected(loaded.error());
    co_return;
  }
  store.follow(map);
  auto const layer = layer_of(options.layer);
  auto const site = site_for(map, options.site);
  if (!layer || !site) {
    put = std::unexpected(layer ? site.error() : layer.error());
    co_return;
  }
  auto contents = formats::import_map(
      options.other, {.layer = *layer, .site = *site, .floor = options.floor, .account = {.writer = options.writer}});
  put = contents ? put_into(map, *std::move(contents), options.writer) : std::unexpected(contents.error());
  if (!put) co_return;
  if (auto const written = co_await store.flush(); !written) put = std::unexpected(written.error());
}

int read_in(StoreOptions const& options) {
  base::Loop loop;
  base::Result<std::size_t> put = 0U;
  {
    auto store = map::Store::open(loop, {.address = options.store});
    if (!store) return host::refuse(store.error());
    loop.run_until_done(import_into(**store, options, put));
  }
  if (!put) return host::refuse(put.error());
  fmt::print("{} things are on the map now that were not, or are other ones\n", *put);
  return host::exit_done;
}

CLI::App* part(CLI::App& store, StoreOptions& options, std::string const& name, std::string const& about,
               int& exit_code, int (*work)(StoreOptions const&)) {
  auto* const verb = store.add_subcommand(name, about);
  verb->add_option("store", options.store, "A folder, or postgresql://USER@HOST/DATABASE")->required();
  verb->callback([&options, &exit_code, work] { exit_code = work(options); });
  return verb;
}

}  // namespace

void add_store(CLI::App& program, int& exit_code) {
  auto const options = std::make_shared<StoreOptions>();
  auto* const verb = begin_verb(program, "store");
  verb->require_subcommand(1);
  part(*verb, *options, "ls", "What is in it", exit_code, list);
  part(*verb, *options, "verify", "Read all of it and say what is wrong", exit_code, verify);
  auto* const smaller = part(*verb, *options, "compact",
                             "Take away what is beyond the limits, and give the disk its space", exit_code, compact);
  smaller->add_option("--most-mb", options->most_mb, "The oldest past goes beyond it, then the oldest pictures");
  smaller->add_option("--days", options->days, "Past that is older goes")->check(CLI::Range(1, 36500));
  auto* const other =
      part(*verb, *options, "copy", "Copy all that is kept into another one, which must be empty", exit_code, copy);
  other->add_option("to", options->other, "A folder, or postgresql://USER@HOST/DATABASE")->required();
  add_export(*verb, exit_code);
  add_formats(*verb, exit_code);
  auto* const in =
      part(*verb, *options, "import", "Put on the map what is in a file of another program", exit_code, read_in);
  in->add_option("file", options->other, "GeoPackage, GeoJSON, KML, CSV, Shapefile, ..., GeoTIFF or a ROS map's .yaml")
      ->required()
      ->check(CLI::ExistingPath);
  in->add_option("--layer", options->layer, "What features are whose table does not say it");
  in->add_option("--site", options->site, "Where they lie, if the file does not say it");
  in->add_option("--floor", options->floor, "On which floor, if the file does not say it");
  in->add_option("--writer", options->writer, "By whom they are, if the file does not say it")->capture_default_str();
  // The options live as long as what is called back.
  verb->final_callback([options] {});
}

}  // namespace lapwing::apps
