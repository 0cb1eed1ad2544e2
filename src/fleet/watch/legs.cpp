#include "fleet/watch/legs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "plan/estimate.hpp"
#include "plan/mission.hpp"
#include "plan/performance.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using mavlink::MavCmd;
using mavlink::MissionItem;

namespace {

bool takes_off(MavCmd command) {
  return command == MavCmd::nav_takeoff || command == MavCmd::nav_vtol_takeoff;
}

bool comes_down(MavCmd command) {
  return command == MavCmd::nav_land || command == MavCmd::nav_vtol_land || command == MavCmd::nav_return_to_launch;
}

/// A mission without a take-off is for who flies already.
std::vector<bool> items_in_the_air(std::vector<MissionItem> const& items) {
  bool flies = std::ranges::none_of(items, takes_off, &MissionItem::command);
  std::vector<bool> in_the_air;
  for (auto const& item : items) {
    if (comes_down(item.command)) flies = false;
    in_the_air.push_back(flies);
    if (takes_off(item.command)) flies = true;
  }
  return in_the_air;
}

/// What the estimate knows the duration of.
bool has_known_duration(MissionItem const& item) {
  switch (item.command) {
    case MavCmd::nav_waypoint:
    case MavCmd::nav_spline_waypoint:
    case MavCmd::nav_loiter_turns:
    case MavCmd::nav_loiter_time:
    case MavCmd::nav_loiter_to_alt:
    case MavCmd::nav_return_to_launch:
    case MavCmd::nav_land:
    case MavCmd::nav_vtol_land:
    case MavCmd::nav_takeoff:
    case MavCmd::nav_vtol_takeoff: return true;
    case MavCmd::nav_delay: return item.params[0] > 0.0F;  // else until a time of the day
    default: return false;
  }
}

}  // namespace

bool is_navigation(MavCmd command) {
  constexpr int last_nav_command = 95;  // MAV_CMD_NAV_LAST
  return std::to_underlying(command) <= last_nav_command;
}

Legs::Legs(std::vector<MissionItem> items, std::optional<geo::Wgs84> home, vehicle::Family family)
    : items_(std::move(items)), home_(home), family_(family), in_the_air_(items_in_the_air(items_)) {}

MissionItem const* Legs::at(int seq) const {
  for (auto i = static_cast<std::size_t>(std::max(seq, 0)); i < items_.size(); ++i)
    if (is_navigation(items_[i].command)) return &items_[i];
  return nullptr;
}

bool Legs::is_in_the_air(int seq) const {
  auto const* item = at(seq);
  return item && in_the_air_[static_cast<std::size_t>(item - items_.data())];
}

std::optional<geo::Wgs84> Legs::target(int seq, geo::Wgs84 here) const {
  auto const* item = at(seq);
  if (!item) return std::nullopt;
  switch (item->command) {
    case MavCmd::nav_return_to_launch: return home_;
    case MavCmd::nav_waypoint:
    case MavCmd::nav_spline_waypoint:
    case MavCmd::nav_land:
    case MavCmd::nav_vtol_land: return plan::place_of(*item, here, home_ ? home_->alt_m : 0.0);
    default: return std::nullopt;
  }
}

std::optional<base::Duration> Legs::patience(int seq, geo::Wgs84 here) const {
  auto const* item = at(seq);
  if (!item || !has_known_duration(*item)) return std::nullopt;
  plan::Mission const leg{.name = {}, .home = home_, .items = {*item}};
  auto const expected = plan::estimate(leg, here, plan::performance_of(family_));
  auto const hold_s = item->command == MavCmd::nav_waypoint && item->params[0] > 0.0F ? item->params[0] : 0.0F;
  return 1min + 2 * (expected.duration + base::from_seconds(hold_s));
}

}  // namespace lapwing::fleet
