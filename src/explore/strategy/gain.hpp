#pragma once

#include <vector>

#include "explore/known/frontiers.hpp"
#include "explore/known/known_map.hpp"

namespace lapwing::explore {

/// Square metres of unknown within `reach_m` of a frontier that a robot would see from its middle if nothing stood in
/// it: what it may bring to go there (González-Baños & Latombe 2002).
[[nodiscard]] double unknown_beyond_m2(KnownMap const& map, Frontier const& frontier, double reach_m);

/// Square metres of unknown that open frontiers seem to hide, each cell once: what is connected with one and no further
/// from its middle than twice its length, at most `reach_m`. How wide an opening is tells about how far the unknown
/// behind it goes on: beyond a gap between two beams there is mostly a wall, beyond an open corridor mostly a corridor.
[[nodiscard]] double hidden_m2(KnownMap const& map, std::vector<Frontier> const& frontiers, double reach_m);

}  // namespace lapwing::explore
