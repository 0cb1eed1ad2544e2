#pragma once

#include <string>

#include "dryrun/analysis.hpp"

namespace lapwing::dryrun {

/// What a dry run found, for a terminal: totals, the tasks of each vehicle, the missions with their items, how near
/// vehicles came to each other, and where they left the fence. UTF-8, ends with a line end.
[[nodiscard]] std::string to_text(FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence);

}  // namespace lapwing::dryrun
