#pragma once

#include "base/open_metrics.hpp"
#include "route/router.hpp"

namespace lapwing::route {

/// Everything that a router counts, by endpoint; drops by reason.
void write_metrics(Router const& router, base::OpenMetrics& metrics);

}  // namespace lapwing::route
