#pragma once

#include <string>

#include "mavlink/connection.hpp"
#include "route/router.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::apps {

/// What a station's /metrics shows: vehicles, links and, where it forwards, the router.
[[nodiscard]] std::string metrics_of(vehicle::Registry const& vehicles, mavlink::Connection const& connection,
                                     route::Router const* forwarding);

}  // namespace lapwing::apps
