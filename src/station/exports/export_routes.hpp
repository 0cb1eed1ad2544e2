#pragma once

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/exports/export_jobs.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// `/api/v1/exports`: what the map can be written as, exports that run, and their files. `jobs` is null where nobody
/// writes any; all outlive the router.
void add_export_routes(Router& router, base::Loop& loop, map::LiveMap const& map, ExportJobs* jobs);

}  // namespace lapwing::station
