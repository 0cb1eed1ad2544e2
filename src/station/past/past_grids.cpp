#include "station/past/past_grids.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/async/pool.hpp"
#include "geo/site.hpp"
#include "map/grid/png.hpp"
#include "station/map/grids/tile_range.hpp"
#include "station/map/grids/under_way.hpp"

namespace lapwing::station {

namespace {

using namespace std::chrono_literals;
using map::GridPyramid;
using map::Shade;

/// What has been shown later than that may not all be kept yet.
constexpr auto settled_after = 10s;
/// Tiles that are compared at a time: some megabytes.
constexpr std::size_t compared_at_once = 32;

/// What has become of a cell, such that of several the greatest is the one to show.
constexpr Shade is_other = 1;
constexpr Shade is_freed = 2;
constexpr Shade is_taken = 3;

enum class Class { unknown, free, taken };

/// As ROS's map_server has it by its usual thresholds.
std::array<Class, 256> const& classes() {
  static auto const all = [] {
    std::array<Class, 256> made = {};
    for (int shade = 0; shade < 256; ++shade) {
      auto const probability = map::probability_of(static_cast<Shade>(shade));
      if (!probability) continue;
      if (*probability > 0.65) made[static_cast<std::size_t>(shade)] = Class::taken;
      if (*probability < 0.25) made[static_cast<std::size_t>(shade)] = Class::free;
    }
    return made;
  }();
  return all;
}

Shade change_of(Shade before, Shade after) {
  auto const was = classes()[before];
  auto const is = classes()[after];
  if (was == is) return 0;
  if (is == Class::taken) return is_taken;
  return was == Class::taken ? is_freed : is_other;
}

/// Null is a tile of which nothing is known.
map::TileShades changes_of(GridPyramid::Tile const* before, GridPyramid::Tile const* after) {
  map::TileShades changes = {};
  for (std::size_t i = 0; i < changes.size(); ++i)
    changes[i] = change_of(before ? before->level(0)[i] : Shade{0}, after ? after->level(0)[i] : Shade{0});
  return changes;
}

GridPyramid::Tile const* at(GridPyramid::Tiles const& tiles, map::TileKey const& key) {
  auto const found = tiles.find(key);
  return found == tiles.end() ? nullptr : found->second.get();
}

map::Palette const& change_palette() {
  static map::Palette const palette = [] {
    map::Palette made = {};
    made[is_other] = {.red = 0xE6, .green = 0x9F, .blue = 0x00, .opacity = 0xB0};
    made[is_freed] = {.red = 0xD5, .green = 0x2B, .blue = 0x1E, .opacity = 0xD0};
    made[is_taken] = {.red = 0x0B, .green = 0x8F, .blue = 0x4D, .opacity = 0xD0};
    return made;
  }();
  return palette;
}

std::string draw(GridPyramid const& pyramid, geo::Site const& site, map::XyzTile tile, map::Palette const& palette) {
  auto shades = map::render(pyramid, site, tile);
  if (!shades) shades.emplace(std::size_t{map::tile_px} * map::tile_px);
  return map::png_of(*shades, map::tile_px, palette);
}

std::string draw_grid(map::GridPlace const& place, GridPyramid::Tiles const& tiles, geo::Site const& site,
                      map::XyzTile tile, std::string const& grid) {
  return draw(GridPyramid(place.resolution_m, place.site_from_grid, tiles), site, tile, map::palette_for(grid));
}

std::string draw_changes(map::GridPlace const& place, GridPyramid::Tiles const& before, GridPyramid::Tiles const& after,
                         geo::Site const& site, map::XyzTile tile) {
  GridPyramid::Tiles changed;
  for (auto const* side : {&before, &after})
    for (auto const& [key, one] : *side)
      if (auto& made = changed[key]; !made)
        made = std::make_shared<GridPyramid::Tile>(changes_of(at(before, key), at(after, key)));
  return draw(GridPyramid(place.resolution_m, place.site_from_grid, std::move(changed)), site, tile, change_palette());
}

/// By kind of change.
std::array<std::size_t, 4> count_changes(GridPyramid::Tiles const& before, GridPyramid::Tiles const& after) {
  std::array<std::size_t, 4> counts = {};
  std::set<map::TileKey> keys;
  for (auto const* side : {&before, &after})
    for (auto const& [key, one] : *side) keys.insert(key);
  for (auto const& key : keys)
    for (auto const change : changes_of(at(before, key), at(after, key))) ++counts[change];
  return counts;
}

using NamedShades = std::vector<std::pair<std::string, std::shared_ptr<map::TileShades const>>>;
using NamedTiles = std::vector<std::pair<std::string, std::shared_ptr<GridPyramid::Tile const>>>;

NamedTiles make_ready(NamedShades const& all) {
  NamedTiles ready;
  for (auto const& [name, shades] : all) ready.emplace_back(name, std::make_shared<GridPyramid::Tile>(*shades));
  return ready;
}

/// Of which of them a picture may show something.
std::map<map::TileKey, std::string> within(std::map<map::TileKey, std::string> names,
                                           std::optional<TileRange> const& range) {
  std::erase_if(names, [&](auto const& one) { return !range || !range->contains(one.first); });
  return names;
}

std::string tag_of(std::string_view kind, map::GridPlace const& place,
                   std::initializer_list<std::map<map::TileKey, std::string> const*> sides) {
  std::string all = fmt::format("{} {} {} {} {} {} {}", kind, place.resolution_m, place.site_from_grid.origin().x(),
                                place.site_from_grid.origin().y(), place.site_from_grid.yaw_rad(), place.anchor.lat_rad,
                                place.anchor.lon_rad);
  for (auto const* side : sides)
    for (auto const& [key, name] : *side) all += fmt::format("/{},{} {}", key.x, key.y, name);
  return fmt::format("\"past-{:016x}\"", std::hash<std::string>()(all));
}

map::GridPlace const& place_of(map::PastGrid const* before, map::PastGrid const* after) {
  return after ? after->place : before->place;
}

base::Result<geo::Site> site_of(map::GridPlace const& place) {
  return geo::Site::make("past", place.anchor);
}

std::unexpected<base::Error> no_grid(map::GridKey const& key) {
  return base::fail(base::ErrorKind::not_found, fmt::format("There was no grid \"{}\" then.", key.name),
                    "The grids of a moment stand in /api/v1/history/{session}/state.");
}

map::PastGrid const* find(map::PastGrids const& grids, map::GridKey const& key) {
  auto const found = grids.find(key);
  return found == grids.end() ? nullptr : &found->second;
}

}  // namespace

PastGrids::PastGrids(base::Loop& loop, map::Store& store, Options options)
    : loop_(loop), store_(store), options_(options), ended_(loop) {}

base::Task<base::Result<PastGrids::Picture>> PastGrids::picture(Moment moment, map::GridKey key, map::XyzTile tile) {
  auto const shown = co_await grids(std::move(moment));
  if (!shown) co_return std::unexpected(shown.error());
  auto const* grid = find(**shown, key);
  if (!grid) co_return no_grid(key);
  auto const site = site_of(grid->place);
  if (!site) co_return std::unexpected(site.error());
  auto const names =
      within(grid->tiles, tiles_under(grid->place.resolution_m, grid->place.site_from_grid, *site, tile));
  auto ready = co_await tiles(names);
  if (!ready) co_return std::unexpected(ready.error());
  auto png = co_await loop_.on_pool(draw_grid, grid->place, *std::move(ready), *site, tile, key.name);
  co_return Picture{std::move(png), tag_of("grid", grid->place, {&names})};
}

base::Task<base::Result<PastGrids::Picture>> PastGrids::changes(Moment from, Moment to, map::GridKey key,
                                                                map::XyzTile tile) {
  auto const before = co_await grids(std::move(from));
  if (!before) co_return std::unexpected(before.error());
  auto const after = co_await grids(std::move(to));
  if (!after) co_return std::unexpected(after.error());
  auto const* was = find(**before, key);
  auto const* is = find(**after, key);
  if (!was && !is) co_return no_grid(key);
  auto pair = pair_of(was, is);
  auto const site = site_of(pair.place);
  if (!site) co_return std::unexpected(site.error());
  auto const range = tiles_under(pair.place.resolution_m, pair.place.site_from_grid, *site, tile);
  auto const names_before = within(std::move(pair.before), range);
  auto const names_after = within(std::move(pair.after), range);
  auto tiles_before = co_await tiles(names_before);
  if (!tiles_before) co_return std::unexpected(tiles_before.error());
  auto tiles_after = co_await tiles(names_after);
  if (!tiles_after) co_return std::unexpected(tiles_after.error());
  auto png =
      co_await loop_.on_pool(draw_changes, pair.place, *std::move(tiles_before), *std::move(tiles_after), *site, tile);
  co_return Picture{std::move(png), tag_of("changes", pair.place, {&names_before, &names_after})};
}

base::Task<base::Result<std::vector<PastGrids::Difference>>> PastGrids::compare(Moment from, Moment to) {
  auto const before = co_await grids(std::move(from));
  if (!before) co_return std::unexpected(before.error());
  auto const after = co_await grids(std::move(to));
  if (!after) co_return std::unexpected(after.error());
  std::set<map::GridKey> keys;
  for (auto const* side : {before->get(), after->get()})
    for (auto const& [key, grid] : *side) keys.insert(key);
  std::vector<Difference> differences;
  for (auto const& key : keys) {
    auto pair = pair_of(find(**before, key), find(**after, key));
    Difference difference{.key = key, .place = pair.place, .is_anew = pair.is_anew};
    std::set<map::TileKey> changed;
    for (auto const* side : {&pair.before, &pair.after})
      for (auto const& [tile, name] : *side) changed.insert(tile);
    difference.tiles.assign(changed.begin(), changed.end());
    for (std::size_t i = 0; i < difference.tiles.size(); i += compared_at_once) {
      TileRange const part{difference.tiles[i],
                           difference.tiles[std::min(i + compared_at_once, difference.tiles.size()) - 1]};
      // In the order of keys, not in a rectangle.
      auto const some = [&](Names const& names) {
        return Names(names.lower_bound(part.least), names.upper_bound(part.most));
      };
      auto tiles_before = co_await tiles(some(pair.before));
      if (!tiles_before) co_return std::unexpected(tiles_before.error());
      auto tiles_after = co_await tiles(some(pair.after));
      if (!tiles_after) co_return std::unexpected(tiles_after.error());
      auto const counts = co_await loop_.on_pool(count_changes, *std::move(tiles_before), *std::move(tiles_after));
      difference.taken += counts[is_taken];
      difference.freed += counts[is_freed];
      difference.other += counts[is_other];
    }
    if (difference.taken + difference.freed + difference.other > 0) differences.push_back(std::move(difference));
  }
  co_return differences;
}

PastGrids::Pair PastGrids::pair_of(map::PastGrid const* before, map::PastGrid const* after) {
  Pair pair{.place = place_of(before, after), .is_anew = false, .before = {}, .after = {}};
  pair.is_anew = before && after && !map::has_same_cells(before->place, after->place);
  if (pair.is_anew) before = nullptr;
  if (before) pair.before = before->tiles;
  if (after) pair.after = after->tiles;
  std::erase_if(pair.before, [&](auto const& one) {
    auto const found = pair.after.find(one.first);
    if (found == pair.after.end() || found->second != one.second) return false;
    pair.after.erase(found);
    return true;
  });
  return pair;
}

base::Task<base::Result<PastGrids::Moments>> PastGrids::grids(Moment moment) {
  while (being_read_.contains(moment)) co_await ended_.wait();
  auto const known = std::ranges::find(moments_, moment, &std::pair<Moment, Moments>::first);
  if (known != moments_.end()) {
    moments_.splice(moments_.begin(), moments_, known);
    co_return moments_.front().second;
  }
  UnderWay const entry(being_read_, moment, ended_);
  auto read = co_await store_.grids_at(moment.session, moment.at);
  if (!read) co_return std::unexpected(read.error());
  auto grids = std::make_shared<map::PastGrids const>(*std::move(read));
  if (moment.at + settled_after < loop_.utc_now()) keep(moment, grids);
  co_return grids;
}

void PastGrids::keep(Moment const& moment, Moments grids) {
  moments_.emplace_front(moment, std::move(grids));
  if (moments_.size() > options_.most_moments) moments_.pop_back();
}

base::Task<base::Result<map::GridPyramid::Tiles>> PastGrids::tiles(Names names) {
  // One after the other: those who ask at once want the same tiles.
  while (reads_tiles_) co_await ended_.wait();
  std::map<std::string, Tile> found;
  std::set<std::string> missing;
  for (auto const& [key, name] : names) {
    auto const known = tiles_.find(name);
    if (known == tiles_.end()) {
      missing.insert(name);
      continue;
    }
    used_.splice(used_.begin(), used_, known->second.used);
    found[name] = known->second.tile;
  }
  if (!missing.empty())
    if (auto done = co_await read(std::move(missing), found); !done) co_return std::unexpected(done.error());
  GridPyramid::Tiles tiles;
  for (auto const& [key, name] : names)
    if (auto const tile = found.find(name); tile != found.end()) tiles[key] = tile->second;
  co_return tiles;
}

base::Task<base::Result<>> PastGrids::read(std::set<std::string> missing, std::map<std::string, Tile>& found) {
  struct Reading {
    explicit Reading(bool& reads_in, base::Notifier& ended_in) : reads(reads_in), ended(ended_in) { reads = true; }
    Reading(Reading const&) = delete;
    Reading& operator=(Reading const&) = delete;
    ~Reading() {
      reads = false;
      ended.notify_all();
    }
    bool& reads;
    base::Notifier& ended;
  };
  Reading const reading(reads_tiles_, ended_);
  auto shades = co_await store_.shades({missing.begin(), missing.end()});
  if (!shades) co_return std::unexpected(shades.error());
  auto ready = co_await loop_.on_pool(make_ready, NamedShades(shades->begin(), shades->end()));
  for (auto& [name, tile] : ready) {
    keep(name, tile);
    found[name] = std::move(tile);
  }
  co_return base::Result<>();
}

void PastGrids::keep(std::string const& name, Tile tile) {
  if (tiles_.contains(name)) return;
  used_.push_front(name);
  tiles_.emplace(name, Kept{std::move(tile), used_.begin()});
  if (tiles_.size() <= options_.most_tiles) return;
  tiles_.erase(used_.back());
  used_.pop_back();
}

}  // namespace lapwing::station
