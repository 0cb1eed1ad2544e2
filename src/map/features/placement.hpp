#pragma once

#include "geo/site.hpp"
#include "map/features/geometry.hpp"

/// Between the plane of a site's map and the globe: what each border uses, so that all agree to the last digit.
///
/// The map of a site is the plane that touches the ellipsoid at the anchor; a floor's height above it does not move
/// what lies on it. A place on the globe is told by longitude and latitude alone: its height on the plane follows.
namespace lapwing::map {

/// Longitude within half a turn of the anchor's, so beyond +-180 degrees where the site lies across the antimeridian:
/// lines and polygons stay in one piece. The altitude is that of the plane.
[[nodiscard]] geo::Wgs84 place_of(geo::Site const& site, SitePoint const& point);
/// The other way, for a longitude in any turn; the altitude is not looked at. Exact to a micrometre within
/// `farthest_m`; what lies anywhere else comes out beyond that.
[[nodiscard]] SitePoint point_of(geo::Site const& site, double lon_rad, double lat_rad);

}  // namespace lapwing::map
