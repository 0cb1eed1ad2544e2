#pragma once

#include "geo/transform.hpp"
#include "map/features/geometry.hpp"
#include "map/grid/occupancy_grid.hpp"

namespace lapwing::robot {

[[nodiscard]] map::SitePoint away(map::SitePoint const& from, double way_rad, double by_m);

/// What a map knows to be free and taken, by places of the site. The map outlives it.
class FreeSpace {
 public:
  explicit FreeSpace(map::OccupancyGrid const& grid) : grid_(grid), grid_from_site_(grid.site_from_grid().inverse()) {}

  [[nodiscard]] bool is_free(map::SitePoint const& place) const;
  [[nodiscard]] bool is_taken(map::SitePoint const& place) const;
  /// For a robot that stands there.
  [[nodiscard]] bool has_room(map::SitePoint const& place) const;
  /// All of the straight way.
  [[nodiscard]] bool is_clear(map::SitePoint const& from, map::SitePoint const& to) const;

 private:
  map::OccupancyGrid const& grid_;
  geo::Transform<map::GridFrame, geo::SiteFrame> grid_from_site_;
};

}  // namespace lapwing::robot
