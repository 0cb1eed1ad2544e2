#pragma once

#include <optional>
#include <string>

#include "plan/fence.hpp"
#include "sim/model/mission_plan.hpp"

namespace lapwing::sim {

/// Why ArduPilot would not take the item into a fence or rally list (its `type` says which); `accepted` when it would.
[[nodiscard]] mavlink::MavMissionResult zone_refusal(mavlink::MissionItem const& item);
/// The fence or rally item as it reads back.
[[nodiscard]] mavlink::MissionItem normalised_zone(mavlink::MissionItem item);
/// What is wrong with a whole fence, in ArduPilot's words; nothing when it is good.
[[nodiscard]] std::optional<std::string> fence_problem(MissionPlan const& fence);

/// An area of a stored fence, level, in the site's frame: a polygon, or without one a circle.
struct FenceArea {
  bool includes = true;  ///< stay inside; else outside
  plan::Polygon polygon{};
  plan::LevelPoint center{};
  double radius_m = 0.0;
};
/// The areas of a good fence.
[[nodiscard]] std::vector<FenceArea> fence_areas(MissionPlan const& fence, Site const& site);
[[nodiscard]] bool contains(FenceArea const& area, geo::Ned point);
/// From inside or outside.
[[nodiscard]] double distance_to_edge_m(FenceArea const& area, geo::Ned point);

}  // namespace lapwing::sim
