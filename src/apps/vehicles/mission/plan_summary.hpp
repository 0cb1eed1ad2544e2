#pragma once

#include <string>
#include <vector>

#include "apps/vehicles/mission/vehicle_plans.hpp"
#include "plan/plan.hpp"

namespace lapwing::apps {

/// A plan for people: its items one a line, fence, rally points, estimated length.
[[nodiscard]] std::string to_text(plan::Plan const& plan);
/// "mission: 7 items uploaded in 0.3 s"
[[nodiscard]] std::string to_text(fleet::MavlinkVehicle const& craft, ListReport const& report);
/// What `lapwing mission --json` prints. `craft` may be null.
[[nodiscard]] std::string to_json(fleet::MavlinkVehicle const* craft, std::vector<ListReport> const& reports,
                                  plan::Plan const& plan);

}  // namespace lapwing::apps
