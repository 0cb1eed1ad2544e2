#pragma once

#include <string>

#include "explore/run/exploration.hpp"

namespace lapwing::explore {

/// The floor as the run left it, as SVG: walls black, seen white, what was wanted and not seen red, and each robot's
/// path in a colour of its own, from a dot where it started.
[[nodiscard]] std::string svg_of(Exploration const& exploration);

}  // namespace lapwing::explore
