#pragma once

#include <vector>

#include "base/error.hpp"
#include "explore/floor/floor_plan.hpp"
#include "explore/run/settings.hpp"
#include "explore/simulated/world.hpp"

namespace lapwing::explore {

/// One of the possible starts, by the seed; in the plan's frame. Error: invalid_input where a robot fits nowhere.
[[nodiscard]] base::Result<Pose> random_start(FloorPlan const& plan, std::vector<Place> const& possible,
                                              std::uint64_t seed);

/// Places for all robots around `first`, as near as they can stand without touching; in the world's frame, all looking
/// the same way. Error: invalid_input where there is no room for so many.
[[nodiscard]] base::Result<std::vector<Pose>> starts_around(World const& world, Pose const& first,
                                                            Settings const& settings);

}  // namespace lapwing::explore
