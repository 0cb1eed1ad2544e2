#pragma once

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// The map as OGC API Features 1.0 and, of grids, OGC API Tiles 1.0 under /ogc, for QGIS, GDAL and others that know
/// these. Both outlive the router and its work.
void add_ogc_routes(Router& router, base::Loop& loop, map::LiveMap const& map);

}  // namespace lapwing::station
