#include "sim/fence_plan.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

namespace lapwing::sim {

using mavlink::MavCmd;
using mavlink::MavMissionResult;

namespace {

bool is_vertex(MavCmd command) {
  return command == MavCmd::nav_fence_polygon_vertex_inclusion || command == MavCmd::nav_fence_polygon_vertex_exclusion;
}

bool belongs(mavlink::MissionItem const& item) {
  if (item.type == mavlink::MissionType::rally) return item.command == MavCmd::nav_rally_point;
  return is_vertex(item.command) || item.command == MavCmd::nav_fence_circle_inclusion ||
         item.command == MavCmd::nav_fence_circle_exclusion || item.command == MavCmd::nav_fence_return_point;
}

}  // namespace

MavMissionResult zone_refusal(mavlink::MissionItem const& item) {
  if (!belongs(item)) return MavMissionResult::unsupported;
  if (!mavlink::is_global(item.frame)) return MavMissionResult::unsupported_frame;
  if (!(std::abs(item.place.lat_rad) <= std::numbers::pi / 2.0)) return MavMissionResult::invalid_param5_x;
  if (!(std::abs(item.place.lon_rad) <= std::numbers::pi)) return MavMissionResult::invalid_param6_y;
  return MavMissionResult::accepted;
}

mavlink::MissionItem normalised_zone(mavlink::MissionItem item) {
  item.current = 0;
  item.autocontinue = false;
  item.target = {};
  item.form = mavlink::ItemForm::integer;
  return item;
}

std::optional<std::string> fence_problem(MissionPlan const& fence) {
  for (std::size_t i = 0; i < fence.size();) {
    if (!is_vertex(fence[i].command)) {
      ++i;
      continue;
    }
    auto const count = static_cast<int>(fence[i].params[0]);
    if (count < 3) return fmt::format("Invalid vertex count ({})", count);
    for (int k = 0; k < count; ++k, ++i) {
      bool const same = i < fence.size() && fence[i].command == fence[i - static_cast<std::size_t>(k)].command &&
                        static_cast<int>(fence[i].params[0]) == count;
      if (!same) return "Incorrect vertex count";
    }
  }
  return std::nullopt;
}

}  // namespace lapwing::sim
