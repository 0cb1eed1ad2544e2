#include "missions/mission_task.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plan/capabilities.hpp"
#include "plan/plausibility/judge.hpp"

namespace lapwing::missions {

namespace {

/// Why no vehicle of that type could carry out the mission, its autopilot being unknown: ArduPilot's takes the most.
std::optional<std::string> unsuited_type(plan::Mission const& mission, std::string_view type) {
  std::optional<std::string> why;
  for (auto const family : plan::families_of(type)) {
    auto constexpr autopilot = vehicle::Autopilot::ardupilot;
    auto const items = plan::for_autopilot(mission, autopilot, std::nullopt, family);
    auto objection = plan::objection(items, autopilot, family);
    if (!objection) return std::nullopt;
    why = std::move(objection->message);
  }
  return why;
}

}  // namespace

std::optional<std::string> MissionTask::unsuited(tasks::VehicleInfo const& vehicle) const {
  if (auto why = unsuited_type(mission_, vehicle.type)) return why;
  if (vehicle.payload.empty() || !plan::takes_photos(mission_)) return std::nullopt;
  if (std::ranges::find(vehicle.payload, "Camera") != vehicle.payload.end()) return std::nullopt;
  return "no payload Camera";
}

std::optional<geo::Wgs84> MissionTask::reference_position() const {
  if (mission_.home) return mission_.home;
  for (auto const& item : mission_.items) {
    auto const place = plan::position_of(item);
    bool const is_here = place.lat_rad == 0.0 && place.lon_rad == 0.0;
    if (plan::has_position(item) && item.command != mavlink::MavCmd::do_set_home && !is_here) return place;
  }
  return std::nullopt;
}

std::optional<tasks::Doubt> MissionTask::cannot_follow(tasks::PlatformTask const& before) const {
  auto const* earlier = dynamic_cast<MissionTask const*>(&before);
  if (!earlier) return std::nullopt;
  auto const findings = plan::plausibility::judge_order(earlier->mission_, mission_, settings_);
  auto const* found = refusal(findings);
  if (!found) return std::nullopt;
  return tasks::Doubt{
      .call = std::nullopt, .what = fmt::format("{} [{}]", found->what, to_string(found->rule)), .hint = found->meant};
}

bool MissionTask::never_ends() const {
  return std::ranges::find(mission_.items, mavlink::MavCmd::nav_loiter_unlim, &mavlink::MissionItem::command) !=
         mission_.items.end();
}

}  // namespace lapwing::missions
