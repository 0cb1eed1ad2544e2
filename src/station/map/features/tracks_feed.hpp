#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <unordered_map>

#include "map/live/live_map.hpp"
#include "station/feeds/feed.hpp"

namespace lapwing::station {

/// Where vehicles have been, as `tracks` messages: a track that has grown is told by its new points alone.
///
/// Only who has been told everything knows all tracks as they were: its revision is even. One that is in the middle of
/// what it is told (odd) may lack a track that has changed meanwhile, and is told whole ones until it is through.
class TracksFeed final : public Feed {
 public:
  /// The map outlives it.
  explicit TracksFeed(map::LiveMap const& map) : map_(map) {}

  [[nodiscard]] std::string_view name() const override { return "map.tracks"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  /// A change of a track: so many of its first points stayed as they were.
  struct Change {
    map::Revision revision = 0;
    std::size_t stayed = 0;
  };
  struct Known {
    std::size_t points = 0;
    map::Track::Sample last = {};
    std::string site = {};
    geo::Wgs84 anchor = {};
    std::deque<Change> changes = {};  ///< the latest; who has missed more is told all of the track
  };

  void look_at(map::FeatureRecord const& record);
  /// How many first points a viewer has that stay as they are.
  [[nodiscard]] std::size_t stayed(map::FeatureRecord const& record, map::Revision viewer) const;

  map::LiveMap const& map_;
  std::unordered_map<std::string, Known> known_;  ///< by id
  map::Revision newest_ = 0;
};

}  // namespace lapwing::station
