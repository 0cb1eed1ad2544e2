#pragma once

#include "explore/known/frontiers.hpp"
#include "explore/known/known_map.hpp"

namespace lapwing::explore {

/// Square metres of unknown within `reach_m` of a frontier that a robot would see from its middle if nothing stood in
/// it: what it may bring to go there (González-Baños & Latombe 2002).
[[nodiscard]] double unknown_beyond_m2(KnownMap const& map, Frontier const& frontier, double reach_m);

}  // namespace lapwing::explore
