#include "fleet/watch/planned_places.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "plan/mission.hpp"

namespace lapwing::fleet {

using mavlink::MavCmd;
using mavlink::MissionItem;
using vehicle::Autopilot;
using vehicle::Family;

namespace {

bool is_wing(Family family) {
  return family == Family::plane || family == Family::vtol;
}

/// The item to which the jump at `index` leads.
std::optional<std::size_t> target_of(std::span<MissionItem const> items, MissionItem const& jump) {
  if (jump.command == MavCmd::do_jump)
    return jump.params[0] >= 0.0F ? std::optional(static_cast<std::size_t>(jump.params[0])) : std::nullopt;
  auto const is_tag = [&](MissionItem const& item) {
    return item.command == MavCmd::jump_tag && item.params[0] == jump.params[0];
  };
  auto const tag = std::ranges::find_if(items, is_tag);
  return tag == items.end() ? std::nullopt : std::optional(static_cast<std::size_t>(tag - items.begin()));
}

/// Which items are begun at some time. How often a jump is taken does not matter for that, only whether.
std::vector<bool> begun_items(std::span<MissionItem const> items, std::size_t first) {
  std::vector<bool> is_begun(items.size());
  std::vector<std::size_t> open{first};
  while (!open.empty()) {
    auto const index = open.back();
    open.pop_back();
    if (index >= items.size() || is_begun[index]) continue;
    is_begun[index] = true;
    auto const& item = items[index];
    bool const jumps = item.command == MavCmd::do_jump || item.command == MavCmd::do_jump_tag;
    auto const target = jumps ? target_of(items, item) : std::nullopt;
    bool const is_taken = target && item.params[1] != 0.0F;
    if (is_taken) open.push_back(*target);
    bool const goes_on = !is_taken || item.params[1] > 0.0F;
    if (goes_on && item.command != MavCmd::nav_loiter_unlim) open.push_back(index + 1);
  }
  return is_begun;
}

bool is_gone_to(MissionItem const& item) {
  switch (item.command) {
    case MavCmd::nav_waypoint:
    case MavCmd::nav_spline_waypoint:
    case MavCmd::nav_loiter_unlim:
    case MavCmd::nav_loiter_turns:
    case MavCmd::nav_loiter_time:
    case MavCmd::nav_loiter_to_alt:
    case MavCmd::nav_payload_place:
    case MavCmd::nav_land:
    case MavCmd::nav_vtol_land: break;
    default: return false;
  }
  bool const says_here = item.place.lat_rad == 0.0 && item.place.lon_rad == 0.0;
  return mavlink::is_global(item.frame) && !says_here;
}

/// How near an autopilot of the kind comes to a waypoint by its own settings, as far as people set them.
double usual_radius_m(Family family) {
  switch (family) {
    case Family::plane:
    case Family::vtol: return 250.0;  // WP_RADIUS is 90; in a wind it counts as reached what was flown past
    case Family::rover:
    case Family::robot:
    case Family::sub: return 15.0;
    case Family::boat: return 30.0;
    case Family::copter: return 20.0;
    case Family::unknown: break;
  }
  return 50.0;
}

double circle_radius_m(MissionItem const& item, Family family) {
  constexpr double not_said = 200.0;  // then a parameter of the vehicle's says it
  bool const is_circle = item.command == MavCmd::nav_loiter_turns || item.command == MavCmd::nav_loiter_unlim ||
                         item.command == MavCmd::nav_loiter_time || item.command == MavCmd::nav_loiter_to_alt;
  if (!is_circle || (!is_wing(family) && item.command != MavCmd::nav_loiter_turns)) return 0.0;
  double const said_m = std::abs(item.params[item.command == MavCmd::nav_loiter_to_alt ? 1 : 2]);
  return std::isfinite(said_m) && said_m > 1.0 ? said_m : not_said;
}

double radius_m(MissionItem const& item, Autopilot autopilot, Family family) {
  constexpr double longest_run_m = 250.0;  // of a wing beyond or before the point where it should touch down
  constexpr double most_accepted_m = 1000.0;
  double radius_m = usual_radius_m(family) + circle_radius_m(item, family);
  // ArduPilot's copters and rovers do not look at an item's own acceptance radius.
  bool const takes_acceptance = autopilot != Autopilot::ardupilot || is_wing(family);
  double const accepted_m = item.params[1];
  bool const is_waypoint = item.command == MavCmd::nav_waypoint || item.command == MavCmd::nav_spline_waypoint;
  if (is_waypoint && takes_acceptance && accepted_m > 0.0) radius_m += std::min(accepted_m, most_accepted_m);
  if (item.command == MavCmd::nav_land && is_wing(family)) radius_m += longest_run_m;
  return radius_m;
}

}  // namespace

std::vector<PlannedPlace> planned_places(std::span<MissionItem const> items, std::size_t first, Autopilot autopilot,
                                         Family family) {
  std::vector<PlannedPlace> places;
  auto const is_begun = begun_items(items, first);
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (!is_begun[i] || !is_gone_to(items[i])) continue;
    places.push_back({static_cast<int>(i), plan::position_of(items[i]), radius_m(items[i], autopilot, family)});
  }
  return places;
}

}  // namespace lapwing::fleet
