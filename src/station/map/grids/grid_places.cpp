#include "station/map/grids/grid_places.hpp"

namespace lapwing::station {

void GridPlaces::look() {
  if (map_.revision() == looked_at_) return;
  looked_at_ = map_.revision();
  for (auto const& [key, record] : map_.grids()) {
    auto const anchor = map_.site(key.site)->anchor();
    auto const& frame = record.grid.site_from_grid();
    auto& place = places_[key];
    bool const is_there = place.resolution_m == record.grid.resolution_m() && place.anchor == anchor &&
                          place.site_from_grid.origin() == frame.origin() &&
                          place.site_from_grid.yaw_rad() == frame.yaw_rad();
    if (!is_there) place = {record.grid.resolution_m(), frame, anchor, looked_at_};
  }
}

map::Revision GridPlaces::since(map::GridKey const& key) const {
  auto const place = places_.find(key);
  return place == places_.end() ? 0 : place->second.since;
}

}  // namespace lapwing::station
