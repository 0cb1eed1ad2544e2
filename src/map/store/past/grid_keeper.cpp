#include "map/store/past/grid_keeper.hpp"

#include <utility>

namespace lapwing::map::past {

namespace {

using namespace std::chrono_literals;

/// Who wants to see a tile unpacks so many. More would save little: most of what a tile takes is what changes.
constexpr int most_steps = 16;
/// A list of all is kept anew when the news since then are so many times larger, and after some time in any case: what
/// came before is thrown away one day.
constexpr std::size_t most_growth = 4;
constexpr auto longest_without_whole = 15min;

/// How it looks now; what must be kept of it is added to `kept`.
GridKeeper::Seen seen_now(GridKeeper::TileWork const& work, std::vector<PackedShades>& kept) {
  if (!work.tile) return {};
  auto const& before = work.seen;
  auto shades = std::make_shared<TileShades const>(shades_of(*work.tile));
  if (before.shades && *before.shades == *shades) return before;
  GridKeeper::Seen now{
      .shades = shades, .name = name_of(*shades), .steps = before.steps + 1, .whole_bytes = before.whole_bytes};
  if (before.shades && now.steps < most_steps) {
    auto bytes = packed(*shades, *before.shades);
    if (2 * bytes.size() < before.whole_bytes) {
      kept.push_back({now.name, before.name, std::move(bytes)});
      return now;
    }
  }
  auto bytes = packed(*shades);
  now.steps = 0;
  now.whole_bytes = bytes.size();
  kept.push_back({now.name, "", std::move(bytes)});
  return now;
}

/// Changes of one grid's tiles become those that are kept of it; what is different is listed.
void take_over(std::map<TileKey, GridKeeper::Seen> const& seen, std::map<TileKey, GridKeeper::Seen>& tiles,
               GridList& list) {
  for (auto const& [tile, now] : seen) {
    auto const before = tiles.find(tile);
    bool const is_same = before == tiles.end() ? now.name.empty() : before->second.name == now.name;
    if (!is_same) list.tiles[tile] = now.name;
    if (now.name.empty())
      tiles.erase(tile);
    else
      tiles[tile] = now;
  }
}

}  // namespace

std::optional<GridKeeper::GridWork> GridKeeper::news_of(GridRecord const& record, Grid const* known,
                                                        GridPlace const& place) {
  bool const is_new = !known || known->revision < record.made;
  bool const is_elsewhere = !is_new && !(has_same_cells(known->place, place) && known->place.anchor == place.anchor);
  if (!is_new && !is_elsewhere && known->revision == record.revision) return std::nullopt;
  GridWork news{.place = place, .revision = record.revision, .is_anew = is_new, .tiles = {}};
  auto const since = is_new ? 0 : known->revision;
  for (auto const& [tile, revision] : record.tile_revisions) {
    if (revision <= since) continue;
    auto const present = record.grid.tiles().find(tile);
    auto& one = news.tiles[tile];
    if (present != record.grid.tiles().end()) one.tile = present->second;
    if (is_new) continue;
    if (auto const seen = known->tiles.find(tile); seen != known->tiles.end()) one.seen = seen->second;
  }
  return news;
}

std::optional<GridKeeper::Work> GridKeeper::take(LiveMap const& map, std::string const& session, base::UtcTime now) {
  Work work;
  work.is_whole = listed_.session != session || now - listed_.at >= longest_without_whole ||
                  listed_.bytes_since > most_growth * listed_.whole_bytes;
  if (listed_.session != session) {
    // What this one says must not hang on what another has kept, which may go before it.
    grids_.clear();
    listed_.session = session;
  }
  for (auto const& [key, record] : map.grids()) {
    auto const known = grids_.find(key);
    GridPlace const place{record.grid.resolution_m(), record.grid.site_from_grid(), map.site(key.site)->anchor()};
    if (auto news = news_of(record, known == grids_.end() ? nullptr : &known->second, place))
      work.grids.emplace(key, *std::move(news));
  }
  bool const is_nothing_there = work.grids.empty() && grids_.empty();
  if (is_nothing_there || (work.grids.empty() && !work.is_whole)) return std::nullopt;
  if (work.is_whole) listed_.at = now;
  return work;
}

GridKeeper::Packed GridKeeper::pack(Work const& work) {
  Packed packed;
  for (auto const& [key, grid] : work.grids)
    for (auto const& [tile, one] : grid.tiles) packed.seen[key][tile] = seen_now(one, packed.shades);
  return packed;
}

GridKeeper::Lists GridKeeper::done(Work const& work, Packed const& packed) {
  Lists news{.frames = {}, .is_whole = false, .names = {}};
  for (auto const& [key, changed] : work.grids) {
    auto& grid = grids_[key];
    if (changed.is_anew) grid.tiles.clear();
    GridList list{.key = key, .place = changed.place, .is_anew = changed.is_anew, .tiles = {}};
    if (auto const seen = packed.seen.find(key); seen != packed.seen.end()) take_over(seen->second, grid.tiles, list);
    bool const has_moved = changed.is_anew || !(grid.place.anchor == changed.place.anchor);
    grid.place = changed.place;
    grid.revision = changed.revision;
    if (work.is_whole || (!has_moved && list.tiles.empty())) continue;
    news.frames.push_back(past::packed(list));
    listed_.bytes_since += news.frames.back().size();
  }
  return work.is_whole ? all_lists() : news;
}

GridKeeper::Lists GridKeeper::all_lists() {
  Lists all{.frames = {}, .is_whole = true, .names = {}};
  listed_.whole_bytes = 0;
  listed_.bytes_since = 0;
  for (auto const& [key, grid] : grids_) {
    GridList list{.key = key, .place = grid.place, .is_anew = true, .tiles = {}};
    for (auto const& [tile, seen] : grid.tiles) {
      list.tiles[tile] = seen.name;
      all.names.push_back(seen.name);
    }
    all.frames.push_back(past::packed(list));
    listed_.whole_bytes += all.frames.back().size();
  }
  return all;
}

}  // namespace lapwing::map::past
