#pragma once

#include <memory>
#include <string>

#include <ogr_geometry.h>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "map/features/geometry.hpp"

namespace lapwing::formats::internal {

/// In longitude and latitude, degrees. Outer rings go counterclockwise, holes clockwise (RFC 7946).
[[nodiscard]] std::unique_ptr<OGRGeometry> on_globe(map::Geometry const& geometry, geo::Site const& site);

/// From longitude and latitude. A collection of one part is that part; heights are left out. Error, invalid_input: what
/// is neither a point, a line string nor a polygon.
[[nodiscard]] base::Result<map::Geometry> in_site(OGRGeometry const& geometry, geo::Site const& site);

}  // namespace lapwing::formats::internal
