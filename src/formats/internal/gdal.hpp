#pragma once

#include <functional>
#include <string>
#include <string_view>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "base/error.hpp"
#include "geo/site.hpp"

/// What every use of GDAL here begins with. Only sources of this room include it.
namespace lapwing::formats::internal {

/// The drivers of files, without any that reaches the network: a file from somebody else must not make us fetch
/// anything. Again and again without harm.
void start_gdal();

/// Runs `work` with what GDAL complains of kept: an error with `what` and the last complaint when `work` says false.
[[nodiscard]] base::Result<> with_gdal(std::string_view what, std::function<bool()> const& work);
/// What GDAL complained of last on this thread, as the end of a sentence.
[[nodiscard]] std::string last_complaint();

/// Longitude before latitude, as GIS files have it.
[[nodiscard]] OGRSpatialReference wgs84_lon_lat();
/// The plane of a site as geodesists write it: azimuthal equidistant about the anchor, x east, y north. It differs from
/// the site's own plane by the sixth part of the cube of the distance over the square of Earth's radius: 4 um at 1 km.
[[nodiscard]] OGRSpatialReference plane_of(geo::Site const& site);

}  // namespace lapwing::formats::internal
