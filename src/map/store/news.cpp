#include "map/store/news.hpp"

#include <algorithm>

#include "map/features/properties.hpp"

namespace lapwing::map {

namespace {

/// What a place loses on its way through longitude and latitude is far below that.
constexpr double alike_m = 1e-5;

bool is_near(SitePoint const& a, SitePoint const& b) {
  return geo::distance_m(a, b) <= alike_m;
}

bool are_near(std::vector<SitePoint> const& a, std::vector<SitePoint> const& b) {
  return std::ranges::equal(a, b, is_near);
}

bool is_alike(Geometry const& a, Geometry const& b) {
  if (a.index() != b.index()) return false;
  if (auto const* point = std::get_if<SitePoint>(&a)) return is_near(*point, std::get<SitePoint>(b));
  if (auto const* line = std::get_if<LineString>(&a)) return are_near(line->points, std::get<LineString>(b).points);
  return std::ranges::equal(std::get<SitePolygon>(a).rings, std::get<SitePolygon>(b).rings, are_near);
}

bool is_alike(Feature const& a, Feature const& b) {
  if (a.account != b.account || a.held_over != b.held_over || a.site != b.site || a.floor != b.floor) return false;
  for (auto const& property : properties_of(layer_of(a.content)))
    if (property.get(a.content) != property.get(b.content)) return false;
  return is_alike(geometry_of(a.content), geometry_of(b.content));
}

void apply(LiveMap& map, Feature const& theirs, write::Pending& pending, std::vector<std::string>& faults) {
  auto const layer = layer_of(theirs.content);
  if (auto put = map.put(theirs); !put) return faults.push_back(put.error().message);
  auto const* record = map.find(layer, theirs.id);
  if (record && !record->is_removed && is_alike(record->feature, theirs)) return;
  pending.note(write::FeatureKey(layer, theirs.id));
}

void apply(LiveMap& map, rows::Removal const& theirs, write::Pending& pending, std::vector<std::string>& faults) {
  if (map.find(theirs.layer, theirs.id)) {
    if (auto removed = map.remove(theirs.layer, theirs.id, theirs.account); !removed)
      return faults.push_back(removed.error().message);
  } else if (auto restored = map.restore(removed_record(theirs)); !restored) {
    return faults.push_back(restored.error().message);
  }
  auto const* record = map.find(theirs.layer, theirs.id);
  // It stands again, or they know of an older removal than we do.
  if (record && (!record->is_removed || record->removal != theirs.account))
    pending.note(write::FeatureKey(theirs.layer, theirs.id));
}

void apply(LiveMap& map, GridKey const& key, rows::GridPart const& theirs, write::Pending& pending,
           std::vector<std::string>& faults) {
  if (auto put = put_tiles(map, key, theirs); !put) return faults.push_back(put.error().message);
  auto const ours = map.grids().find(key);
  if (ours == map.grids().end()) return;
  for (auto const& [where, tile] : theirs.tiles) {
    auto const time = ours->second.tile_times.find(where);
    if (time != ours->second.tile_times.end() && time->second > tile.at) pending.note(key, where);
  }
}

}  // namespace

FeatureRecord removed_record(rows::Removal const& removal) {
  return {.is_removed = true,
          .feature = {.id = removal.id,
                      .site = removal.site,
                      .floor = removal.floor,
                      .account = removal.account,
                      .content = write::nothing_of(removal.layer)},
          .removal = removal.account};
}

base::Result<> put_tiles(LiveMap& map, GridKey const& key, rows::GridPart const& part) {
  OccupancyGrid grid(part.resolution_m, part.site_from_grid);
  std::map<base::UtcTime, std::vector<TileKey>> by_time;
  for (auto const& [where, kept] : part.tiles) {
    if (kept.tile) grid.set_tile(where, kept.tile);
    by_time[kept.at].push_back(where);
  }
  for (auto const& [time, tiles] : by_time) {
    auto const put = map.put_tiles(key, grid, tiles, {part.account.writer, time});
    if (!put) return std::unexpected(put.error());
  }
  return {};
}

std::vector<std::string> apply_news(LiveMap& map, write::News const& news, write::Pending& pending) {
  std::vector<std::string> faults = news.changes.faults;
  for (auto const& [id, site] : news.sites) map.put_site(site);
  // First those that stand: a removal of one that nobody here has heard of is only remembered.
  for (auto const& feature : news.changes.features) apply(map, feature, pending, faults);
  for (auto const& removal : news.changes.removals) apply(map, removal, pending, faults);
  for (auto const& [key, part] : news.grids) apply(map, key, part, pending, faults);
  return faults;
}

}  // namespace lapwing::map
