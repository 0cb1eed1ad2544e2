#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>

#include "map/live/live_map.hpp"
#include "station/feeds/feed.hpp"

namespace lapwing::station {

/// The features of one layer, as `features` messages: all of them for a newcomer, then what changed and what is gone.
/// When a site moves, everything of it is news.
class FeatureFeed final : public Feed {
 public:
  /// The map outlives it.
  FeatureFeed(map::LiveMap const& map, map::LayerKind layer);

  [[nodiscard]] std::string_view name() const override { return name_; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

  /// What has been written as JSON is kept for the next viewer, so many bytes of it.
  static constexpr std::size_t most_kept_bytes = std::size_t{16} * 1024 * 1024;

 private:
  struct Text {
    map::Revision revision = 0;
    std::string json = {};
  };
  [[nodiscard]] std::string const& text_of(map::FeatureRecord const& record) const;

  map::LiveMap const& map_;
  map::LayerKind layer_;
  std::string name_;
  map::Revision newest_ = 0;                             ///< viewers count from 1: theirs is one more
  mutable std::unordered_map<std::string, Text> texts_;  ///< by id
  mutable std::size_t kept_bytes_ = 0;
};

}  // namespace lapwing::station
