#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "plan/capabilities.hpp"
#include "plan/estimate.hpp"
#include "plan/files/plan_file.hpp"
#include "plan/files/vehicle_plan.hpp"
#include "require.hpp"

/// What must hold for any bytes taken as a plan: refused with a reason, or a plan that can be made ready for every
/// vehicle, and written in every format so that it can be read again.
namespace lapwing::fuzz {

inline void check_mission(plan::Mission const& mission) {
  using vehicle::Autopilot;
  using vehicle::Family;
  require(mission.items.size() <= plan::max_mission_items);
  require(std::isfinite(plan::estimate(mission).path_m));
  for (auto const autopilot : {Autopilot::ardupilot, Autopilot::px4}) {
    for (auto const family : {Family::copter, Family::plane, Family::rover}) {
      auto const items = plan::for_autopilot(mission, autopilot, mission.planned_home, family);
      for (std::size_t i = 0; i < items.size(); ++i) require(items[i].seq == i);
      if (auto const wrong = plan::objection(items, autopilot, family)) require(!wrong->message.empty());
    }
  }
}

inline void check_fence(plan::GeoFence const& fence) {
  require(fence.zones.size() <= plan::max_fence_zones);
  std::vector<std::string> lost;
  auto const simple = plan::simple_fence(fence, lost);
  require(plan::fence_from(plan::fence_items(simple)).has_value());
}

/// `is_again`: the plan was written by us.
inline void check_plan(std::string_view text, bool is_again = false) {
  auto const read = plan::read_plan("fuzz", text, {.altitude_m = 30.0});
  if (!read) {
    require(!is_again && !read.error().message.empty());
    return;
  }
  check_mission(read->plan.mission);
  check_fence(read->plan.fence);
  if (is_again) return;
  using enum plan::PlanFormat;
  for (auto const format : {qgc_plan, way_points, kml, geojson}) {
    auto const written = plan::write_plan(read->plan, format);
    if (written && written->text.size() <= plan::max_plan_bytes) check_plan(written->text, true);
  }
}

}  // namespace lapwing::fuzz
