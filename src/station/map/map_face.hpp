#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/feeds/feed.hpp"
#include "station/http/router.hpp"
#include "station/map/blob_store.hpp"
#include "station/map/grids/grid_pictures.hpp"

namespace lapwing::station {

/// The map as viewers and programs see it: its feeds, its HTTP API, and its OGC API.
class MapFace {
 public:
  /// Loop, map and store outlive it. `blobs` is null where no pictures are kept.
  MapFace(base::Loop& loop, map::LiveMap& map, BlobStore* blobs);

  /// Sites, each layer, grids. They outlive neither this nor the map.
  [[nodiscard]] std::vector<std::unique_ptr<Feed>> feeds() const;
  void add_routes(Router& router);

 private:
  base::Loop& loop_;
  map::LiveMap& map_;
  BlobStore* blobs_;
  std::string run_;  ///< tells pictures of this process from those of the one before it
  std::shared_ptr<GridPlaces> places_;
  GridPictures pictures_;
};

}  // namespace lapwing::station
