#include "fleet/mission/flight_plan.hpp"

#include <algorithm>
#include <span>

#include "fleet/watch/legs.hpp"

namespace lapwing::fleet {

using mavlink::MavCmd;

namespace {

MissionEnding ending_of(MavCmd command) {
  switch (command) {
    case MavCmd::nav_land:
    case MavCmd::nav_vtol_land:
    case MavCmd::nav_return_to_launch: return MissionEnding::on_ground;
    case MavCmd::nav_loiter_unlim: return MissionEnding::never;
    default: return MissionEnding::at_place;
  }
}

/// Without what is never reached: ArduPilot's planes leave the mission for good where it says "return to launch".
std::span<mavlink::MissionItem const> reachable(std::vector<mavlink::MissionItem> const& items,
                                                vehicle::VehicleState const& vehicle) {
  bool const is_wing = vehicle.family == vehicle::Family::plane || vehicle.family == vehicle::Family::vtol;
  if (!is_wing || vehicle.autopilot != vehicle::Autopilot::ardupilot) return items;
  auto const end = std::ranges::find(items, MavCmd::nav_return_to_launch, &mavlink::MissionItem::command);
  return {items.begin(), end == items.end() ? end : end + 1};
}

MissionShape shape_of(std::span<mavlink::MissionItem const> items) {
  MissionShape shape{.last_nav_seq = static_cast<int>(items.size()) - 1, .ending = MissionEnding::never};
  for (auto item = items.rbegin(); item != items.rend(); ++item) {
    if (item->command == MavCmd::do_jump) return shape;  // the last place is reached more than once
    if (!is_navigation(item->command)) continue;
    shape.last_nav_seq = item->seq;
    shape.ending = ending_of(item->command);
    return shape;
  }
  return shape;
}

}  // namespace

FlightPlan flight_plan(plan::Mission const& mission, vehicle::VehicleState const& vehicle) {
  FlightPlan flight;
  flight.items = plan::for_autopilot(mission, vehicle.autopilot, vehicle.motion.home.value, vehicle.family);
  flight.first_seq = static_cast<std::uint16_t>(flight.items.size() - mission.items.size());
  auto const flown = reachable(flight.items, vehicle);
  flight.shape = shape_of(flown);
  flight.places = planned_places(flown, flight.first_seq, vehicle.autopilot, vehicle.family);
  auto const home = mission.home ? mission.home : vehicle.motion.home.value;
  flight.home = home;
  for (auto const& item : mission.items) {
    if (!plan::has_position(item) || !is_navigation(item.command)) continue;
    auto const here = flight.path.empty() ? home : flight.path.back();
    flight.path.push_back(plan::place_of(item, here, home ? home->alt_m : 0.0));
  }
  return flight;
}

}  // namespace lapwing::fleet
