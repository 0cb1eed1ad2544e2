#include "station/map/features/tracks_feed.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/text/utc_text.hpp"
#include "map/features/placement.hpp"
#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

constexpr std::size_t most_changes = 100;

/// What a viewer has, behind its revision.
struct Standing {
  map::Revision reached = 0;
  bool has_all = false;  ///< as of then
};
Standing standing_of(std::uint64_t revision) {
  if (revision == 0) return {};
  return {(revision - 1) / 2, revision % 2 == 0};
}
std::uint64_t revision_of(Standing const& standing) {
  return 2 * standing.reached + (standing.has_all ? 2 : 1);
}

/// Those from that index on; times count from the first of all.
std::string track_text(map::Feature const& feature, geo::Site const& site, std::size_t from) {
  auto const& track = std::get<map::Track>(feature.content);
  auto const began = track.samples.front().at;
  Json points = Json::array();
  for (auto i = from; i < track.samples.size(); ++i) {
    auto const& sample = track.samples[i];
    auto const place = map::place_of(site, sample.position);
    points.push_back({rounded(place.lon_deg(), 7), rounded(place.lat_deg(), 7), rounded(sample.up_m, 2),
                      rounded(base::to_seconds(sample.at - began), 2)});
  }
  return dump({{"id", feature.id},
               {"vehicle", track.vehicle},
               {"site", feature.site},
               {"floor", feature.floor},
               {"began_at", base::utc_text(began)},
               {"from", from},
               {"points", std::move(points)}});
}

}  // namespace

std::uint64_t TracksFeed::refresh(base::TimePoint) {
  for (auto const* record : map_.changed_since(map::LayerKind::tracks, newest_)) {
    look_at(*record);
    newest_ = record->revision;
  }
  return revision_of({newest_, true});
}

void TracksFeed::look_at(map::FeatureRecord const& record) {
  auto const& feature = record.feature;
  if (record.is_removed) {
    known_.erase(feature.id);
    return;
  }
  auto const& samples = std::get<map::Track>(feature.content).samples;
  auto const anchor = map_.site(feature.site)->anchor();
  auto& known = known_[feature.id];
  // What came late or was thinned moves the last point to another index.
  bool const has_grown = known.points > 0 && known.points <= samples.size() &&
                         samples[known.points - 1] == known.last && known.site == feature.site &&
                         known.anchor == anchor;
  known.changes.push_back({record.revision, has_grown ? known.points : 0});
  if (known.changes.size() > most_changes) known.changes.pop_front();
  known.points = samples.size();
  known.last = samples.back();
  known.site = feature.site;
  known.anchor = anchor;
}

std::size_t TracksFeed::stayed(map::FeatureRecord const& record, map::Revision viewer) const {
  auto const known = known_.find(record.feature.id);
  if (known == known_.end()) return 0;
  auto const& changes = known->second.changes;
  auto const missed = std::ranges::upper_bound(changes, viewer, {}, &Change::revision);
  if (missed == changes.begin() || missed == changes.end()) return 0;
  return std::ranges::min_element(missed, changes.end(), {}, &Change::stayed)->stayed;
}

News TracksFeed::since(std::uint64_t revision, base::TimePoint, std::size_t room) const {
  auto const viewer = standing_of(revision);
  bool const is_whole = revision == 0 || viewer.reached < map_.oldest_remembered(map::LayerKind::tracks);
  std::string tracks;
  std::string removed;
  auto reached = is_whole ? 0 : viewer.reached;
  // No feature takes less than a hundred bytes, so that these fill the room.
  auto const most = room / 100 + 1;
  auto const changed = map_.changed_since(map::LayerKind::tracks, reached, most);
  bool is_all = changed.size() < most;
  for (auto const* record : changed) {
    if (record->revision > newest_) {
      is_all = true;
      break;
    }
    if (tracks.size() + removed.size() >= room) {
      is_all = false;
      break;
    }
    reached = record->revision;
    auto& list = record->is_removed ? removed : tracks;
    if (record->is_removed && is_whole) continue;
    if (!list.empty()) list += ',';
    list += record->is_removed ? dump(record->feature.id)
                               : track_text(record->feature, *map_.site(record->feature.site),
                                            is_whole || !viewer.has_all ? 0 : stayed(*record, viewer.reached));
  }
  if (is_all) reached = newest_;
  if (!is_whole && tracks.empty() && removed.empty()) return {};
  auto text = fmt::format(R"({{"type":"tracks","full":{},"tracks":[{}],"removed":[{}]}})", is_whole, tracks, removed);
  return {is_whole, {{.content = std::move(text), .revision = revision_of({reached, is_all})}}};
}

}  // namespace lapwing::station
