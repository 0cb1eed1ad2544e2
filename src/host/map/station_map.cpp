#include "host/map/station_map.hpp"

#include <stdlib.h>

#include <cstdlib>
#include <utility>

#include <fmt/format.h>

namespace lapwing::host {

namespace {

using ::lapwing::map::LiveMap;
using ::lapwing::map::Store;
namespace fs = std::filesystem;

base::Result<fs::path> new_temporary_folder() {
  auto name = (fs::temp_directory_path() / "lapwing-map-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    return base::fail(base::ErrorKind::io,
                      fmt::format("no temporary folder can be made in {}", fs::temp_directory_path().string()),
                      "is there room? TMPDIR names another place");
  return fs::path(name);
}

base::Task<> load_into(Store& store, LiveMap& map, base::Result<>& loaded) {
  loaded = co_await store.load(map);
}

base::Result<std::unique_ptr<Store>> opened_at(base::Loop& loop, LiveMap& map, StoreSettings const& settings,
                                               std::string address) {
  auto store = Store::open(
      loop, {.address = std::move(address), .most_bytes = settings.most_bytes, .longest = settings.longest});
  if (!store) return store;
  base::Result<> loaded;
  loop.run_until_done(load_into(**store, map, loaded));
  if (!loaded) return std::unexpected(loaded.error());
  (*store)->follow(map);
  return store;
}

}  // namespace

fs::path usual_store() {
  auto const* data = std::getenv("XDG_DATA_HOME");
  if (data && *data != '\0') return fs::path(data) / "lapwing/map";
  auto const* home = std::getenv("HOME");
  return fs::path(home ? home : ".") / ".local/share/lapwing/map";
}

base::Result<std::unique_ptr<StationMap>> StationMap::open(base::Loop& loop, LiveMap& map,
                                                           StoreSettings const& settings, base::Logger const& log) {
  if (settings.place != StoreSettings::Place::temporary) {
    bool const is_named = settings.place == StoreSettings::Place::named;
    auto const address = is_named ? settings.address : usual_store().string();
    auto store = opened_at(loop, map, settings, address);
    if (store) return std::unique_ptr<StationMap>(new StationMap(*std::move(store), address, {}));
    if (is_named) return std::unexpected(store.error());
    log.warn(fmt::format("{}: the map is kept in a temporary folder until this ends; --store FOLDER keeps it for good",
                         store.error().message));
  }
  auto const folder = new_temporary_folder();
  if (!folder) return std::unexpected(folder.error());
  auto store = opened_at(loop, map, settings, folder->string());
  if (!store) return std::unexpected(store.error());
  return std::unique_ptr<StationMap>(new StationMap(*std::move(store), folder->string(), *folder));
}

StationMap::~StationMap() {
  store_.reset();  // writes what is left
  std::error_code ignored;
  if (!goes_with_.empty()) fs::remove_all(goes_with_, ignored);
}

}  // namespace lapwing::host
