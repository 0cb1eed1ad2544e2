#pragma once

#include <map>

#include "map/live/live_map.hpp"

namespace lapwing::station {

/// Since when each grid lies where it lies: pictures of it from before show it elsewhere. A site that moves, and a grid
/// that is made anew, leave their tiles' revisions as they are.
class GridPlaces {
 public:
  /// The map outlives it.
  explicit GridPlaces(map::LiveMap const& map) : map_(map) {}

  /// Takes note of what has moved; call it before the others.
  void look();
  /// 0 for a grid that has not been looked at.
  [[nodiscard]] map::Revision since(map::GridKey const& key) const;

 private:
  struct Place {
    double resolution_m = 0.0;
    geo::Transform<geo::SiteFrame, map::GridFrame> site_from_grid = {};
    geo::Wgs84 anchor = {};
    map::Revision since = 0;
  };
  map::LiveMap const& map_;
  map::Revision looked_at_ = 0;
  std::map<map::GridKey, Place> places_;
};

}  // namespace lapwing::station
