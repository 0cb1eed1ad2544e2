#pragma once

#include <optional>
#include <string>

#include "sim/mission_plan.hpp"

namespace lapwing::sim {

/// Why ArduPilot would not take the item into a fence or rally list (its `type` says which); `accepted` when it would.
[[nodiscard]] mavlink::MavMissionResult zone_refusal(mavlink::MissionItem const& item);
/// The fence or rally item as it reads back.
[[nodiscard]] mavlink::MissionItem normalised_zone(mavlink::MissionItem item);
/// What is wrong with a whole fence, in ArduPilot's words; nothing when it is good.
[[nodiscard]] std::optional<std::string> fence_problem(MissionPlan const& fence);

}  // namespace lapwing::sim
