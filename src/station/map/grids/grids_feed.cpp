#include "station/map/grids/grids_feed.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "station/map/grids/grid_json.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

std::uint64_t GridsFeed::refresh(base::TimePoint) {
  places_->look();
  for (auto const& [key, record] : map_.grids()) newest_ = std::max(newest_, changed(key, record));
  return newest_ + 1;
}

map::Revision GridsFeed::changed(map::GridKey const& key, map::GridRecord const& record) const {
  return std::max(record.revision, places_->since(key));
}

/// With the tiles that changed after that revision; with none when the viewer has nothing of it that still counts.
std::string GridsFeed::text(map::GridKey const& key, map::GridRecord const& record, map::Revision after) const {
  bool const is_new = after < places_->since(key);
  auto json = grid_json(key, record, *map_.site(key.site));
  json["revision"] = changed(key, record);
  json["pictures"] = grid_pictures(key, run_, changed(key, record));
  json["full"] = is_new;
  Json tiles = Json::array();
  if (!is_new)
    for (auto const& [tile, revision] : record.tile_revisions)
      if (revision > after) tiles.push_back({tile.x, tile.y});
  json["changed"] = std::move(tiles);
  return dump(json);
}

News GridsFeed::since(std::uint64_t revision, base::TimePoint, std::size_t room) const {
  bool const is_whole = revision == 0;
  auto const after = is_whole ? 0 : revision - 1;
  std::vector<std::pair<map::Revision, map::GridKey const*>> newer;
  for (auto const& [key, record] : map_.grids())
    if (auto const at = changed(key, record); at > after && at <= newest_) newer.emplace_back(at, &key);
  std::ranges::sort(newer, {}, &std::pair<map::Revision, map::GridKey const*>::first);
  News news{.is_whole = is_whole, .frames = {}};
  std::size_t bytes = 0;
  for (std::size_t i = 0; i < newer.size() && bytes < room; ++i) {
    auto const& [at, key] = newer[i];
    bool const is_step = i + 1 == newer.size() || newer[i + 1].first != at;  // several may have moved at once
    auto content = fmt::format(R"({{"type":"grids","full":{},"grids":[{}]}})", is_whole && i == 0,
                               text(*key, map_.grids().at(*key), after));
    bytes += is_step ? content.size() : 0;
    news.frames.push_back({.content = std::move(content), .revision = is_step ? at + 1 : 0});
  }
  if (is_whole && newer.empty())
    news.frames.push_back({.content = R"({"type":"grids","full":true,"grids":[]})", .revision = newest_ + 1});
  return news;
}

}  // namespace lapwing::station
