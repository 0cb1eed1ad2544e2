#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "map/store/store.hpp"
#include "station/feeds/feed.hpp"
#include "station/http/router.hpp"
#include "station/map/grids/grid_pictures.hpp"
#include "station/past/past_grids.hpp"

namespace lapwing::station {

/// The map as viewers and programs see it: its feeds, its HTTP API, and its OGC API; of the past of grids, too.
class MapFace {
 public:
  /// Loop, map and store outlive it. `store` is null where nothing is kept: no pictures, no past.
  MapFace(base::Loop& loop, map::LiveMap& map, map::Store* store);

  /// With what the names of all its feeds begin.
  static constexpr std::string_view feed_group = "map.";

  /// Sites, each layer, grids. They outlive neither this nor the map.
  [[nodiscard]] std::vector<std::unique_ptr<Feed>> feeds() const;
  void add_routes(Router& router);
  /// Whether anything on the map is new.
  [[nodiscard]] map::Revision revision() const { return map_.revision(); }

 private:
  base::Loop& loop_;
  map::LiveMap& map_;
  map::Store* store_;
  std::string run_;  ///< tells pictures of this process from those of the one before it
  std::shared_ptr<GridPlaces> places_;
  GridPictures pictures_;
  std::unique_ptr<PastGrids> past_;  ///< null without a store
};

}  // namespace lapwing::station
