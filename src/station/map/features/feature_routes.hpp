#pragma once

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// The HTTP face of what lies on the map. Both outlive the router and its work.
void add_feature_routes(Router& router, base::Loop& loop, map::LiveMap& map);

}  // namespace lapwing::station
