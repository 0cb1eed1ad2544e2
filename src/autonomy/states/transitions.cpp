#include "autonomy/states/transitions.hpp"

#include <algorithm>
#include <array>

#include "autonomy/states/actions.hpp"
#include "autonomy/states/guards.hpp"

namespace lapwing::autonomy {

std::span<Transition const> transition_table() {
  using enum State;
  using E = Event;
  namespace g = guards;
  namespace a = actions;
  static std::array const table{
      Transition{any_state, E::kill, {}, a::motors_off, idle},

      Transition{arm, E::failure, {}, a::note_failure_and_disarm, malfunction},
      Transition{takeoff | flight_states, E::failure, {}, a::note_failure, malfunction},
      Transition{arm, E::link_lost, {}, a::say_link_lost_and_disarm, State::communication_lost},
      Transition{takeoff | flight_states, E::link_lost, {}, a::say_link_lost, State::communication_lost},
      Transition{flight_states, E::battery_low, {}, a::say_battery_low, land},

      Transition{idle, E::configure, {}, {}, configure},
      Transition{configure, E::configured, {}, {}, idle},
      Transition{idle, E::arm, g::ready_to_arm, a::begin_arming, arm},
      Transition{idle, E::disarm, g::armed, a::disarm, idle},
      Transition{idle, E::land, g::armed, {}, land},
      Transition{idle, E::found_flying, {}, a::take_over, hover},

      Transition{arm, E::disarm, {}, a::disarm, idle},
      Transition{arm, E::takeoff, g::ready_to_take_off, {}, takeoff},
      Transition{arm, E::gave_up, {}, a::say_not_armed_in_time, idle},

      Transition{takeoff, E::height_reached, {}, {}, hover},
      Transition{takeoff, E::disarmed, {}, a::say_disarmed, arm},
      Transition{takeoff, E::gave_up, {}, a::note_climb, malfunction},

      Transition{takeoff | flight_states, E::land, {}, {}, land},
      Transition{flight_states, E::autonomous_explore, g::in_our_hands, {}, autonomous_explore},
      Transition{flight_states, E::autonomous_move, g::place_by_map, {}, autonomous_move},
      Transition{flight_states, E::compulsive_move, g::place_on_globe, {}, compulsive_move},
      Transition{flight_states, E::disarmed, {}, a::say_disarmed, idle},
      Transition{takeoff | flight_states, E::returns_by_itself, {}, a::say_returns, land},
      Transition{takeoff | flight_states, E::flown_by_hand, {}, a::leave_to_the_hand, hover},

      Transition{autonomous_explore, E::lot_lost, {}, {}, no_parking_lot_detected},
      Transition{autonomous_move, E::place_reached, {}, {}, hover},
      Transition{autonomous_move, E::place_outside, {}, {}, desired_location_error},
      Transition{autonomous_move, E::no_verdict, {}, a::say_no_verdict, hover},
      Transition{compulsive_move, E::place_reached, {}, {}, hover},

      Transition{State::communication_lost, E::link_back, g::in_the_air, a::say_link_back, hover},
      Transition{descents, E::disarmed, {}, {}, idle},
  };
  return table;
}

Transition const* find_transition(State from, Event event) {
  auto const table = transition_table();
  auto const found =
      std::ranges::find_if(table, [&](Transition const& row) { return row.event == event && row.from.has(from); });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace lapwing::autonomy
