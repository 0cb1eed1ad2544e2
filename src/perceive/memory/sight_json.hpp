#pragma once

#include "base/error.hpp"
#include "explore/lot/lot_sight.hpp"
#include "geo/position_json.hpp"

/// One picture's account as JSON, in the frame of its site. For .cpp files.
namespace lapwing::perceive {

/// Places to the millimetre, far below what a camera knows of its own.
[[nodiscard]] geo::Json sight_json(explore::LotSight const& sight);

/// Error, invalid_input: no such account, or one with a number that no camera over a car park has.
[[nodiscard]] base::Result<explore::LotSight> read_sight(geo::Json const& json);

}  // namespace lapwing::perceive
