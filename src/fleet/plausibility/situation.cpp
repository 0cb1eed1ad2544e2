#include "fleet/plausibility/situation.hpp"

namespace lapwing::fleet {

namespace {

/// Zero only when it says that there is none: an autopilot that does not count tells nothing.
std::optional<int> items_held(vehicle::VehicleState const& state) {
  auto const& mission = state.mission.progress.value;
  if (!mission) return std::nullopt;
  if (mission->state == "no mission") return 0;
  return mission->total > 0 ? std::optional(mission->total) : std::nullopt;
}

}  // namespace

bool knows_its_place(MavlinkVehicle const& craft) {
  auto const& health = craft.state.arming.health.value;
  bool const estimated = health && health->position_ok;
  return craft.is_current(craft.state.motion.position) &&
         (estimated || craft.state.autopilot == vehicle::Autopilot::other);
}

std::optional<bool> stands_on_ground(MavlinkVehicle const& craft) {
  if (!craft.heard->is_armed) return true;
  auto const& landed = craft.state.motion.landed;
  return craft.is_current(landed) ? landed.value : std::nullopt;
}

plan::plausibility::Situation situation_of(MavlinkVehicle const& craft, Neighbours const& neighbours) {
  auto const& state = craft.state;
  plan::plausibility::Situation situation{.vehicle = state.name,
                                          .family = state.family,
                                          .autopilot = state.autopilot,
                                          .home = state.motion.home.value,
                                          .on_ground = stands_on_ground(craft),
                                          .items_held = items_held(state),
                                          .own_fence = craft.heard->fence.known(state.autopilot, state.family)};
  if (knows_its_place(craft)) situation.position = state.motion.position.value;
  // What standing on the ground uses says nothing about a flight.
  bool const is_under_way = situation.on_ground == false;
  if (is_under_way && state.power.battery.value) situation.endurance = state.power.battery.value->time_left;
  if (neighbours) situation.neighbours = neighbours(craft);
  return situation;
}

}  // namespace lapwing::fleet
