#pragma once

#include <string>

#include "dryrun/analysis.hpp"

namespace lapwing::dryrun {

/// The same as the text for programs, tracks included: the keys are in docs/reference/command-line.md. Angles in
/// degrees, everything else SI. Ends with a line end.
[[nodiscard]] std::string to_json(FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence);

}  // namespace lapwing::dryrun
