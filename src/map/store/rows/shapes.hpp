#pragma once

#include "geo/site.hpp"
#include "map/features/geometry.hpp"
#include "map/store/sql/wkb.hpp"

namespace lapwing::map::rows {

/// Where it lies on the globe. Rings are closed, and go the way round that they went: a picture's first corner means
/// something.
[[nodiscard]] sql::LonLatGeometry on_globe(Geometry const& geometry, geo::Site const& site);
[[nodiscard]] Geometry on_site(sql::LonLatGeometry const& geometry, geo::Site const& site);

}  // namespace lapwing::map::rows
