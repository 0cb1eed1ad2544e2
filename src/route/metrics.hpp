#pragma once

#include <span>

#include "base/open_metrics.hpp"
#include "route/router.hpp"

namespace lapwing::route {

/// Everything that routers count, by endpoint; drops by reason. Endpoints of several routers have different names.
void write_metrics(std::span<Router const* const> routers, base::OpenMetrics& metrics);

}  // namespace lapwing::route
