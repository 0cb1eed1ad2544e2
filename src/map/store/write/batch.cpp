#include "map/store/write/batch.hpp"

#include <algorithm>

#include "map/store/rows/shade_rows.hpp"
#include "map/store/rows/shown_rows.hpp"
#include "map/store/rows/site_rows.hpp"

namespace lapwing::map::write {

namespace {

base::Result<News> news_since(sql::Database& database, Revision seen) {
  News news;
  auto sites = rows::read_sites(database, seen);
  // What has changed may lie in sites that have not.
  auto const all_sites = rows::read_sites(database);
  if (!sites || !all_sites) return std::unexpected(!sites ? sites.error() : all_sites.error());
  auto changes = rows::changes_since(database, *all_sites, seen);
  if (!changes) return std::unexpected(changes.error());
  auto grids = rows::read_grids(database, seen);
  if (!grids) return std::unexpected(grids.error());
  for (auto& [key, part] : *grids) {
    auto tiles = rows::read_tiles(database, key, seen);
    if (!tiles) return std::unexpected(tiles.error());
    part.tiles = std::move(*tiles);
  }
  return News{std::move(*sites), std::move(*changes), std::move(*grids)};
}

std::set<FeatureKey> keys_of(News const& news) {
  std::set<FeatureKey> keys;
  for (auto const& feature : news.changes.features) keys.emplace(layer_of(feature.content), feature.id);
  for (auto const& removal : news.changes.removals) keys.emplace(removal.layer, removal.id);
  return keys;
}

base::Result<> write_frames(sql::Database& database, Batch const& batch) {
  if (batch.session)
    if (auto named = rows::name_session(database, *batch.session); !named) return named;
  // Before the lists that name them.
  if (auto written = rows::write_shades(database, batch.shades, batch.shades_at); !written) return written;
  if (auto touched = rows::touch_shades(database, batch.listed_shades, batch.shades_at); !touched) return touched;
  return rows::write_shown(database, batch.frames);
}

/// What can be written now, as a part of the batch.
struct Ours {
  std::vector<FeatureRecord> features;
  std::map<GridKey, rows::GridPart> grids;
};

bool lies_alike(rows::GridPart const& a, rows::GridPart const& b) {
  return a.resolution_m == b.resolution_m && a.site_from_grid.origin() == b.site_from_grid.origin() &&
         a.site_from_grid.yaw_rad() == b.site_from_grid.yaw_rad();
}

void pass_over_tiles(Ours& ours, News const& news, std::set<TileName>& passed_over) {
  for (auto const& [key, theirs] : news.grids) {
    auto const part = ours.grids.find(key);
    if (part == ours.grids.end()) continue;
    bool const is_another = !lies_alike(part->second, theirs);
    std::erase_if(part->second.tiles, [&](auto const& tile) {
      if (!is_another && !theirs.tiles.contains(tile.first)) return false;
      passed_over.emplace(key, tile.first);
      return true;
    });
    if (part->second.tiles.empty()) ours.grids.erase(part);
  }
}

Ours without(News const& news, Batch const& batch, PassedOver& passed_over) {
  Ours ours{.features = {}, .grids = batch.grids};
  auto const theirs = keys_of(news);
  for (auto const& record : batch.features) {
    FeatureKey key(layer_of(record.feature.content), record.feature.id);
    // What lies in a site that they have moved would be written at its old place.
    if (theirs.contains(key) || news.sites.contains(record.feature.site)) {
      passed_over.features.insert(std::move(key));
    } else {
      ours.features.push_back(record);
    }
  }
  pass_over_tiles(ours, news, passed_over.tiles);
  return ours;
}

base::Result<> write_map(sql::Database& database, Batch const& batch, Ours const& ours, Revision revision) {
  for (auto const& site : batch.changed_sites)
    if (auto written = rows::write_site(database, batch.sites.at(site), revision); !written) return written;
  if (auto written = rows::write_features(database, ours.features, batch.sites, revision); !written) return written;
  for (auto const& [key, part] : ours.grids)
    if (auto written = rows::write_grid(database, key, part, revision); !written) return written;
  return {};
}

/// Takes the row with the revision, which is held until the end of the transaction.
base::Result<Revision> next_revision(sql::Database& database) {
  auto const held = database.change("UPDATE lapwing_revision SET revision = revision + 1 WHERE one = 1", {});
  if (!held) return std::unexpected(held.error());
  return revision_of(database);
}

base::Result<> write_changes(sql::Database& database, Batch const& batch, Revision seen, Written& written) {
  auto const revision = next_revision(database);
  if (!revision) return std::unexpected(revision.error());
  written.seen = *revision;
  if (*revision - 1 == seen) return write_map(database, batch, {batch.features, batch.grids}, *revision);
  auto news = news_since(database, seen);
  if (!news) return std::unexpected(news.error());
  for (auto const& site : batch.changed_sites) news->sites.erase(site);  // the last word is ours
  auto const ours = without(*news, batch, written.passed_over);
  written.news = std::move(*news);
  return write_map(database, batch, ours, *revision);
}

}  // namespace

base::Result<Revision> revision_of(sql::Database& database) {
  auto const revision = sql::value_of(database, "SELECT revision FROM lapwing_revision WHERE one = 1");
  if (!revision) return std::unexpected(revision.error());
  return static_cast<Revision>(sql::as_integer(*revision).value_or(0));
}

base::Result<Written> write_batch(sql::Database& database, Batch const& batch, Revision seen) {
  auto transaction = sql::Transaction::begin(database);
  if (!transaction) return std::unexpected(transaction.error());
  Written written{.seen = seen};
  if (batch.changes_map())
    if (auto done = write_changes(database, batch, seen, written); !done) return std::unexpected(done.error());
  if (auto done = write_frames(database, batch); !done) return std::unexpected(done.error());
  if (auto committed = transaction->commit(); !committed) return std::unexpected(committed.error());
  return written;
}

base::Result<Written> read_news(sql::Database& database, Revision seen) {
  // Asked before what it counts is read: what comes between is read twice, never not at all.
  auto const revision = revision_of(database);
  if (!revision) return std::unexpected(revision.error());
  Written read{.seen = *revision};
  if (*revision == seen) return read;
  auto news = news_since(database, seen);
  if (!news) return std::unexpected(news.error());
  read.news = std::move(*news);
  return read;
}

}  // namespace lapwing::map::write
