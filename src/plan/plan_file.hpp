#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "plan/mission.hpp"

namespace lapwing::plan {

/// A mission that was drawn elsewhere.
struct PlanFile {
  Mission mission;                 ///< heights keep the frame in which they were drawn; `planned_home` is set
  std::vector<std::string> notes;  ///< what else the file holds, which nobody flies: "a geofence of 2 polygons"
};

/// Larger files are refused unread.
inline constexpr std::size_t max_plan_bytes = 8u << 20;

/// Reads `text` as QGroundControl's plan (JSON, `"fileType": "Plan"`) or as a list of way points ("QGC WPL 110", as
/// QGroundControl, Mission Planner and MAVProxy write it; of "QGC WPL 120", which has no home line, too).
///
/// Of a plan are flown: simple items; surveys, corridors and other transects by the items that QGroundControl stored
/// with them; landing patterns. Item numbers of jumps are translated. `file` is the name for messages and, without its
/// ending, the mission's. Errors are invalid_input and say where: "a.plan: mission.items[3].params[4]: ...",
/// "a.waypoints:7: ...".
[[nodiscard]] base::Result<PlanFile> read_plan(std::string_view file, std::string_view text);

/// "north.plan" -> "north"; directories are dropped too.
[[nodiscard]] std::string plan_name(std::string_view file);

}  // namespace lapwing::plan
