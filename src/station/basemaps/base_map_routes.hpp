#pragma once

#include <vector>

#include "base/async/loop.hpp"
#include "station/basemaps/base_map.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// - `GET /api/v1/basemaps`: which there are, in the order of the configuration, each with what a map needs to show it.
/// - `GET /api/v1/basemaps/{id}/tiles/{z}/{x}/{y}`: a tile of an archive; 204 where it has none.
/// - `GET /api/v1/basemaps/{id}/drawing`: the GeoJSON of drawn ground.
///
/// Files are read beside the loop.
void add_base_map_routes(Router& router, base::Loop& loop, std::vector<BaseMap> const& maps);

}  // namespace lapwing::station
