#pragma once

#include "map/store/store.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// What was shown, for pages that look back ("History" in docs/reference/station-api.md):
///
/// - `GET /api/v1/history`: the sessions that are kept, the newest first.
/// - `GET /api/v1/history/{session}/state?at_ms=T`: the messages that bring an empty page to that moment, in order.
/// - `GET /api/v1/history/{session}/frames?from_ms=A&to_ms=B`: those from A on and before B, as many as fit into an
///   answer, with the time up to which they are complete.
///
/// Times are milliseconds since 1970, UTC. Without a store (null) they answer 404 with the reason.
void add_history_routes(Router& router, map::Store* store);

}  // namespace lapwing::station
