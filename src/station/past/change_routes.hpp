#pragma once

#include "base/async/loop.hpp"
#include "map/store/store.hpp"
#include "station/http/router.hpp"
#include "station/past/past_grids.hpp"

namespace lapwing::station {

/// What has changed between two moments ("History" in docs/reference/openapi.yaml):
///
/// - `GET /api/v1/history/{session}/changes?from_ms=A&to_ms=B`: features by layer, and grids. `to_session` names the
///   run of the later moment, where it is another one.
/// - `GET /api/v1/history/{session}/changes/{site}/{floor}/{name}/{z}/{x}/{y}.png` with the same parameters: a picture
///   of the cells that have changed.
///
/// Without a store (null, and then no grids either) they answer 404 with the reason.
void add_change_routes(Router& router, base::Loop& loop, map::Store* store, PastGrids* grids);

}  // namespace lapwing::station
