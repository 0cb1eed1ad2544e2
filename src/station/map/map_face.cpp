#include "station/map/map_face.hpp"

#include "base/text/random_name.hpp"
#include "station/map/blob_routes.hpp"
#include "station/map/features/feature_feed.hpp"
#include "station/map/features/feature_routes.hpp"
#include "station/map/features/tracks_feed.hpp"
#include "station/map/grids/grid_routes.hpp"
#include "station/map/grids/grids_feed.hpp"
#include "station/map/ogc/ogc_routes.hpp"
#include "station/map/site_routes.hpp"
#include "station/map/sites_feed.hpp"
#include "station/past/change_routes.hpp"

namespace lapwing::station {

MapFace::MapFace(base::Loop& loop, map::LiveMap& map, map::Store* store)
    : loop_(loop),
      map_(map),
      store_(store),
      run_(base::random_name(8)),
      places_(std::make_shared<GridPlaces>(map)),
      pictures_(loop, map, places_),
      past_(store ? std::make_unique<PastGrids>(loop, *store) : nullptr) {}

std::vector<std::unique_ptr<Feed>> MapFace::feeds() const {
  std::vector<std::unique_ptr<Feed>> feeds;
  feeds.push_back(std::make_unique<SitesFeed>(map_));
  for (auto const layer : map::all_layers) {
    if (layer == map::LayerKind::tracks) {
      feeds.push_back(std::make_unique<TracksFeed>(map_));
    } else {
      feeds.push_back(std::make_unique<FeatureFeed>(map_, layer));
    }
  }
  feeds.push_back(std::make_unique<GridsFeed>(map_, places_, run_));
  return feeds;
}

void MapFace::add_routes(Router& router) {
  add_site_routes(router, map_);
  add_feature_routes(router, loop_, map_);
  add_grid_routes(router, loop_, map_, pictures_, past_.get(), run_);
  add_change_routes(router, loop_, store_, past_.get());
  add_blob_routes(router, store_);
  add_ogc_routes(router, loop_, map_);
}

}  // namespace lapwing::station
