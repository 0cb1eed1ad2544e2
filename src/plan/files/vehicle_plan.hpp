#pragma once

#include <span>
#include <string>
#include <vector>

#include "plan/plan.hpp"

/// Between plans and the three lists of items in which vehicles hold them (missions there: `for_autopilot`).
namespace lapwing::plan {

/// A fence of nothing but what vehicles and .plan files know: zones of one polygon without holes, or a circle. Holes
/// of an inclusion become exclusions and polygons of one exclusion become several, which is the same; what cannot be
/// kept (names, limits of height, an exclusion's holes, which are filled) is added to `lost`.
[[nodiscard]] GeoFence simple_fence(GeoFence const& fence, std::vector<std::string>& lost);

/// Of a simple fence, for MissionType::fence.
[[nodiscard]] std::vector<mavlink::MissionItem> fence_items(GeoFence const& simple);
[[nodiscard]] std::vector<mavlink::MissionItem> rally_items(std::span<RallyPoint const> rally);

/// The mission that a vehicle holds: ArduPilot's item 0 becomes `planned_home`, targets of jumps count from 1.
[[nodiscard]] Mission mission_from(std::span<mavlink::MissionItem const> items, vehicle::Autopilot autopilot);
/// Errors: invalid_input, naming the item, for lists that are no fence.
[[nodiscard]] base::Result<GeoFence> fence_from(std::span<mavlink::MissionItem const> items);
[[nodiscard]] base::Result<std::vector<RallyPoint>> rally_from(std::span<mavlink::MissionItem const> items);

/// Which of the three lists a command belongs to.
[[nodiscard]] mavlink::MissionType list_of(mavlink::MavCmd command);

}  // namespace lapwing::plan
