#include "station/map/features/feature_feed.hpp"

#include <utility>

#include <fmt/format.h>

#include "map/features/feature_json.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

/// One more of a list.
void append(std::string& list, std::string_view text) {
  if (!list.empty()) list += ',';
  list += text;
}

}  // namespace

FeatureFeed::FeatureFeed(map::LiveMap const& map, map::LayerKind layer)
    : map_(map), layer_(layer), name_(fmt::format("map.{}", map::name_of(layer))) {}

std::uint64_t FeatureFeed::refresh(base::TimePoint) {
  auto const changed = map_.changed_since(layer_, newest_);
  if (!changed.empty()) newest_ = changed.back()->revision;
  return newest_ + 1;
}

std::string const& FeatureFeed::text_of(map::FeatureRecord const& record) const {
  if (kept_bytes_ > most_kept_bytes) {
    texts_.clear();
    kept_bytes_ = 0;
  }
  auto& text = texts_[record.feature.id];
  if (text.revision == record.revision) return text.json;
  kept_bytes_ -= text.json.size();
  text = {record.revision, dump(map::feature_json(record.feature, *map_.site(record.feature.site)))};
  kept_bytes_ += text.json.size();
  return text.json;
}

News FeatureFeed::since(std::uint64_t revision, base::TimePoint, std::size_t room) const {
  auto reached = revision == 0 ? 0 : revision - 1;
  bool const is_whole = revision == 0 || reached < map_.oldest_remembered(layer_);
  if (is_whole) reached = 0;
  std::string features;
  std::string removed;
  // No feature takes less than a hundred bytes, so that these fill the room.
  auto const most = room / 100 + 1;
  auto const changed = map_.changed_since(layer_, reached, most);
  bool is_all = changed.size() < most;
  for (auto const* record : changed) {
    if (record->revision > newest_) {
      is_all = true;
      break;
    }
    if (features.size() + removed.size() >= room) {
      is_all = false;
      break;
    }
    reached = record->revision;
    if (!record->is_removed) {
      append(features, text_of(*record));
    } else if (!is_whole) {
      append(removed, dump(record->feature.id));
    }
  }
  if (is_all) reached = newest_;
  if (!is_whole && features.empty() && removed.empty()) return {};
  auto text = fmt::format(R"({{"type":"features","layer":"{}","full":{},"features":[{}],"removed":[{}]}})",
                          map::name_of(layer_), is_whole, features, removed);
  return {is_whole, {{.content = std::move(text), .revision = reached + 1}}};
}

}  // namespace lapwing::station
