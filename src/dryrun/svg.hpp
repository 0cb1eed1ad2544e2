#pragma once

#include <string>

#include "dryrun/analysis.hpp"

namespace lapwing::dryrun {

/// A dry run as one picture: a map with tracks, missions, fence and the closest approach, above a time line for each
/// vehicle with its tasks, height (speed for wheels) and battery. SVG 1.1 without scripts and outside parts, legible on
/// light and dark; the same record gives the same bytes.
[[nodiscard]] std::string to_svg(FlightRecord const& record, Analysis const& analysis, plan::Fence const& fence);

}  // namespace lapwing::dryrun
