#pragma once

#include <map>
#include <span>
#include <string>

#include "mavlink/path/link_report.hpp"
#include "route/router.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::host {

/// What a station's /metrics shows: vehicles, the links of all networks, who is heard on each, and, where it forwards,
/// the routers.
[[nodiscard]] std::string metrics_of(vehicle::Registry const& vehicles, std::span<mavlink::LinkReport const> links,
                                     std::map<std::string, route::Router> const& forwarding, base::TimePoint now);

}  // namespace lapwing::host
