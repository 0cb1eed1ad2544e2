#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "map/live/live_map.hpp"
#include "station/feeds/feed.hpp"
#include "station/map/grids/grid_places.hpp"

namespace lapwing::station {

/// Which grids there are and which of their tiles changed, as `grids` messages; no cells. Viewers ask for pictures of
/// what they have in view (grid_routes.hpp), so a slow one falls behind on these alone.
class GridsFeed final : public Feed {
 public:
  /// The map outlives it. `run` tells the pictures of this run of the station from those of another.
  GridsFeed(map::LiveMap const& map, std::shared_ptr<GridPlaces> places, std::string run)
      : map_(map), places_(std::move(places)), run_(std::move(run)) {}

  static constexpr std::string_view feed_name = "map.grids";
  [[nodiscard]] std::string_view name() const override { return feed_name; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  /// The revision of the last thing that a viewer must know of it.
  [[nodiscard]] map::Revision changed(map::GridKey const& key, map::GridRecord const& record) const;
  [[nodiscard]] std::string text(map::GridKey const& key, map::GridRecord const& record, map::Revision after) const;

  map::LiveMap const& map_;
  std::shared_ptr<GridPlaces> places_;
  std::string run_;
  map::Revision newest_ = 0;  ///< viewers count from 1: theirs is one more
};

}  // namespace lapwing::station
