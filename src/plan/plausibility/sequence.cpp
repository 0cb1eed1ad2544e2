#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "plan/plausibility/internal/look.hpp"
#include "plan/plausibility/judge.hpp"

/// Sequence: what there is to fly, and from where it begins.
namespace lapwing::plan::plausibility {

using mavlink::MavCmd;
using vehicle::Autopilot;
using vehicle::Family;

namespace internal {

namespace {

/// The first command that takes the vehicle somewhere; waiting does not.
std::optional<std::size_t> first_way(Mission const& mission) {
  constexpr int last_nav_command = 95;  // MAV_CMD_NAV_LAST: higher ones are done on the way
  for (std::size_t i = 0; i < mission.items.size(); ++i) {
    auto const command = mission.items[i].command;
    if (std::to_underlying(command) <= last_nav_command && command != MavCmd::nav_delay) return i;
  }
  return std::nullopt;
}

bool takes_off_first(Mission const& mission) {
  auto const first = first_way(mission);
  if (!first) return false;
  auto const command = mission.items[*first].command;
  return command == MavCmd::nav_takeoff || command == MavCmd::nav_vtol_takeoff;
}

}  // namespace

/// Copters do not leave the ground without being told to; PX4's do, by themselves, and planes are thrown sometimes.
void judge_sequence(Look const& look, Findings& out) {
  auto const& mission = look.mission;
  if (mission.items.empty()) {
    out.push_back(
        {.rule = Rule::empty_mission, .what = "the mission has no items", .meant = "give it places to go to"});
    return;
  }
  auto const family = look.situation.family;
  bool const must_take_off = family == Family::copter || family == Family::plane || family == Family::vtol;
  auto const first = first_way(mission);
  if (!must_take_off || look.situation.on_ground != true || !first || takes_off_first(mission)) return;
  bool const may_go = look.situation.autopilot == Autopilot::px4 || family == Family::plane;
  out.push_back({.rule = Rule::no_take_off,
                 .severity = may_go ? Severity::warn : Severity::refuse,
                 .item = first,
                 .what = fmt::format("{} stands on the ground, and the mission begins without a take-off",
                                     look.situation.vehicle),
                 .meant = "begin with takeOff; after a landing, too"});
}

bool ends_on_ground(Mission const& mission) {
  for (auto item = mission.items.rbegin(); item != mission.items.rend(); ++item) {
    switch (item->command) {
      case MavCmd::nav_land:
      case MavCmd::nav_vtol_land:
      case MavCmd::nav_return_to_launch: return true;
      case MavCmd::do_jump: return false;
      default:
        if (has_position(*item) && item->command != MavCmd::do_set_home) return false;
    }
  }
  return false;
}

}  // namespace internal

Findings judge_order(Mission const& first, Mission const& second, Settings const& settings) {
  auto const takes_off = [](mavlink::MissionItem const& item) {
    return item.command == MavCmd::nav_takeoff || item.command == MavCmd::nav_vtol_takeoff;
  };
  // Only what takes off somewhere is certain to fly.
  bool const flies = std::ranges::any_of(first.items, takes_off);
  if (!flies || !internal::ends_on_ground(first) || second.items.empty() || internal::takes_off_first(second) ||
      !internal::first_way(second))
    return {};
  Findings findings{{.rule = Rule::no_take_off,
                     .item = internal::first_way(second),
                     .what = fmt::format("'{}' begins without a take-off, and '{}' before it ends on the ground",
                                         second.name, first.name),
                     .meant = "begin it with takeOff, or leave out the landing before it"}};
  return marked(std::move(findings), settings);
}

}  // namespace lapwing::plan::plausibility
