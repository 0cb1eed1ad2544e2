#include "autonomy/states/event.hpp"

#include <array>

namespace lapwing::autonomy {

namespace {

/// In the order of the alternatives of `Command`.
constexpr std::array<Event, command_count> command_events{Event::kill,
                                                          Event::configure,
                                                          Event::arm,
                                                          Event::disarm,
                                                          Event::takeoff,
                                                          Event::land,
                                                          Event::autonomous_explore,
                                                          Event::autonomous_move,
                                                          Event::compulsive_move};

}  // namespace

std::string_view to_string(Event event) {
  using enum Event;
  for (std::size_t i = 0; i < command_events.size(); ++i)
    if (command_events[i] == event) return command_name(i);
  switch (event) {
    case failure: return "failure of the flight controller or a process";
    case link_lost: return "operator link lost";
    case battery_low: return "battery below the reserve";
    case disarmed: return "disarmed";
    case returns_by_itself: return "flight controller returns by itself";
    case flown_by_hand: return "flown by hand";
    case found_flying: return "found flying at the start";
    case configured: return "at once";
    case gave_up: return "not in time";
    case height_reached: return "height reached";
    case place_reached: return "place reached";
    case place_outside: return "planner: not in the lot";
    case no_verdict: return "planner does not answer";
    case lot_lost: return "vision loses the lot";
    default: break;
  }
  return "operator link back";
}

Event event_of(Command const& command) {
  return command_events[command.index()];
}

bool is_command(Event event) {
  return event == Event::kill || (event > last_of_safety && event < first_of_own);
}

}  // namespace lapwing::autonomy
