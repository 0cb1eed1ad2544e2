#pragma once

#include <cstddef>

#include "host/eyes/looking_child.hpp"
#include "robot/poi/eye.hpp"
#include "sim/building/building.hpp"

namespace lapwing::host {

/// What a robot in a simulated building sees with: its cameras, and a child that looks at their pictures. Both outlive
/// the eyes. Nothing is kept: that is the caller's to say.
[[nodiscard]] robot::Eyes simulated_eyes(base::Loop& loop, sim::building::Building& building, std::size_t robot,
                                         LookingChild& child);

}  // namespace lapwing::host
