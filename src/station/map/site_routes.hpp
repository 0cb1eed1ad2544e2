#pragma once

#include "map/live/live_map.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// The HTTP face of sites. The map outlives the router.
void add_site_routes(Router& router, map::LiveMap& map);

}  // namespace lapwing::station
