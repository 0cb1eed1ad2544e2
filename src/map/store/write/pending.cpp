#include "map/store/write/pending.hpp"

#include <algorithm>
#include <iterator>

#include "base/assert.hpp"

namespace lapwing::map::write {

namespace {

/// A transaction of so many takes some tens of milliseconds; larger ones gain little.
constexpr std::size_t most_features = 2000;
/// 8 MiB of cells, to be compressed on the way.
constexpr std::size_t most_tiles = 64;
/// What waits for a disk that is full, or a server that is away.
constexpr std::size_t most_frame_bytes = 32 * 1024 * 1024;

/// A removed one that the map has forgotten in the meantime is taken out, and not remembered either.
FeatureRecord record_of(LiveMap const& map, FeatureKey const& key) {
  if (auto const* found = map.find(key.first, key.second)) return *found;
  return {.is_removed = true, .feature = {.id = key.second, .content = nothing_of(key.first)}};
}

void add_site(Batch& batch, LiveMap const& map, std::string const& id) {
  if (batch.sites.contains(id)) return;
  if (auto const* site = map.site(id)) batch.sites.emplace(id, *site);
}

template <class Key>
std::optional<std::uint64_t> least(std::vector<std::pair<std::uint64_t, Key>> const& taken) {
  return taken.empty() ? std::nullopt : std::optional(taken.front().first);
}

}  // namespace

Content nothing_of(LayerKind layer) {
  switch (layer) {
    case LayerKind::slots: return Slot{};
    case LayerKind::walls: return Wall{};
    case LayerKind::points_of_interest: return PointOfInterest{};
    case LayerKind::pictures: return Picture{};
    case LayerKind::tracks: return Track{};
    case LayerKind::areas: return Area{};
  }
  std::unreachable();
}

void Pending::note(MapChange const& change) {
  ++last_;
  if (!change.site.empty()) sites_.note(change.site, last_);
  for (auto const* record : change.features)
    features_.note({layer_of(record->feature.content), record->feature.id}, last_);
  for (auto const& tile : change.tiles) tiles_.note({change.grid_key, tile}, last_);
}

void Pending::name(Store::Session session) {
  ++last_;
  session_ = std::move(session);
}

bool Pending::record(Store::Shown shown) {
  if (frame_bytes_ + shown.content.size() > most_frame_bytes) return false;
  ++last_;
  if (!has_frames()) first_frame_ = last_;
  frame_bytes_ += shown.content.size();
  frames_.push_back(std::move(shown));
  return true;
}

void Pending::record(std::vector<past::PackedShades> shades, std::vector<std::string> listed, base::UtcTime at) {
  if (!has_frames()) first_frame_ = ++last_;
  for (auto const& one : shades) frame_bytes_ += one.bytes.size();
  std::ranges::move(shades, std::back_inserter(shades_));
  std::ranges::move(listed, std::back_inserter(listed_shades_));
  shades_at_ = at;
}

bool Pending::is_ready_to_record() const {
  return frame_bytes_ < most_frame_bytes / 4;
}

Batch Pending::take(LiveMap const* map, Slow with) {
  Batch batch;
  if (map) {
    way_.sites = sites_.take(most_features);
    for (auto const& [number, id] : way_.sites) {
      batch.changed_sites.push_back(id);
      add_site(batch, *map, id);
    }
    take_features(batch, *map);
    if (with.tiles) take_tiles(batch, *map);
  }
  batch.session = std::exchange(session_, std::nullopt);
  if (!with.frames) return batch;
  if (has_frames()) way_.frames = first_frame_;
  batch.frames = std::exchange(frames_, {});
  batch.shades = std::exchange(shades_, {});
  batch.listed_shades = std::exchange(listed_shades_, {});
  batch.shades_at = shades_at_;
  frame_bytes_ = 0;
  return batch;
}

void Pending::take_features(Batch& batch, LiveMap const& map) {
  way_.features = features_.take(most_features);
  for (auto const& [number, key] : way_.features) {
    batch.features.push_back(record_of(map, key));
    add_site(batch, map, batch.features.back().feature.site);
  }
}

void Pending::take_tiles(Batch& batch, LiveMap const& map) {
  way_.tiles = tiles_.take(most_tiles);
  for (auto const& [number, name] : way_.tiles) {
    auto const& [key, where] = name;
    auto const grid = map.grids().find(key);
    if (grid == map.grids().end()) continue;
    auto& part = batch.grids[key];
    part.resolution_m = grid->second.grid.resolution_m();
    part.site_from_grid = grid->second.grid.site_from_grid();
    part.account = grid->second.account;
    auto const& tiles = grid->second.grid.tiles();
    auto const tile = tiles.find(where);
    auto const time = grid->second.tile_times.find(where);
    part.tiles[where] = {tile == tiles.end() ? nullptr : tile->second,
                         time == grid->second.tile_times.end() ? part.account.at : time->second};
  }
}

void Pending::committed(PassedOver const& passed_over) {
  for (auto& [number, key] : way_.features)
    if (passed_over.features.contains(key)) features_.note(std::move(key), number);
  for (auto& [number, tile] : way_.tiles)
    if (passed_over.tiles.contains(tile)) tiles_.note(std::move(tile), number);
  way_ = {};
}

void Pending::give_back(Batch batch) {
  for (auto& [number, site] : way_.sites) sites_.note(std::move(site), number);
  for (auto& [number, key] : way_.features) features_.note(std::move(key), number);
  for (auto& [number, tile] : way_.tiles) tiles_.note(std::move(tile), number);
  if (batch.session && !session_) session_ = std::move(batch.session);
  if (way_.frames) {
    first_frame_ = *way_.frames;
    std::ranges::move(frames_, std::back_inserter(batch.frames));
    frames_ = std::move(batch.frames);
    std::ranges::move(shades_, std::back_inserter(batch.shades));
    shades_ = std::move(batch.shades);
    std::ranges::move(listed_shades_, std::back_inserter(batch.listed_shades));
    listed_shades_ = std::move(batch.listed_shades);
    frame_bytes_ = 0;
    for (auto const& frame : frames_) frame_bytes_ += frame.content.size();
    for (auto const& one : shades_) frame_bytes_ += one.bytes.size();
  }
  way_ = {};
}

bool Pending::fills_a_batch() const {
  return features_.size() >= most_features || tiles_.size() >= most_tiles || frame_bytes_ > most_frame_bytes / 4;
}

std::size_t Pending::waiting() const {
  return sites_.size() + features_.size() + tiles_.size() + way_.sites.size() + way_.features.size() +
         way_.tiles.size();
}

std::optional<std::uint64_t> Pending::oldest() const {
  std::optional<std::uint64_t> oldest;
  auto const consider = [&](std::optional<std::uint64_t> number) {
    if (number && (!oldest || *number < *oldest)) oldest = number;
  };
  consider(sites_.oldest());
  consider(features_.oldest());
  consider(tiles_.oldest());
  if (has_frames()) consider(first_frame_);
  consider(least(way_.sites));
  consider(least(way_.features));
  consider(least(way_.tiles));
  consider(way_.frames);
  return oldest;
}

}  // namespace lapwing::map::write
