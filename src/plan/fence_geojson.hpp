#pragma once

#include <string_view>

#include "base/error.hpp"
#include "geo/position.hpp"
#include "plan/fence.hpp"

namespace lapwing::plan {

inline constexpr std::size_t max_fence_bytes = std::size_t{16} << 20U;
inline constexpr std::size_t max_fence_zones = 1'000;
inline constexpr std::size_t max_fence_corners = 10'000;  ///< of all zones together
/// Corners farther from home than this are a mistake, most often latitude and longitude swapped.
inline constexpr double max_fence_distance_m = 1e6;

/// Reads a fence from GeoJSON (RFC 7946): a FeatureCollection, a Feature or a geometry; Polygons and MultiPolygons with
/// holes, and Points with a property `radius_m` as circles (of 180 corners). Properties: `name`, `fence` ("inclusion",
/// the default, or "exclusion"), `min_height_m` and `max_height_m` above home or `min_altitude_m` and `max_altitude_m`
/// above sea level; others are ignored. Edges are straight in the local frame at `home`.
///
/// Errors: invalid_input, naming the line or the place in the document ($.features[2].geometry).
[[nodiscard]] base::Result<Fence> read_fence(std::string_view geojson, geo::Wgs84 home);

}  // namespace lapwing::plan
