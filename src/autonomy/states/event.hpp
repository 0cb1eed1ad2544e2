#pragma once

#include <cstdint>
#include <string_view>

#include "autonomy/interface/command.hpp"

namespace lapwing::autonomy {

/// What can happen in a frame, in the order in which it is looked for: Kill, what makes it come down, commands, and
/// what a state waits for.
enum class Event : std::uint8_t {
  kill,

  failure,
  link_lost,
  battery_low,

  configure,
  arm,
  disarm,
  takeoff,
  land,
  autonomous_explore,
  autonomous_move,
  compulsive_move,

  disarmed,
  returns_by_itself,
  flown_by_hand,
  found_flying,
  configured,
  gave_up,
  height_reached,
  place_reached,
  place_outside,
  no_verdict,
  lot_lost,
  link_back,
};
inline constexpr std::size_t event_count = 24;
inline constexpr Event first_of_safety = Event::failure;
inline constexpr Event last_of_safety = Event::battery_low;
inline constexpr Event first_of_own = Event::disarmed;
inline constexpr Event last_of_own = Event::link_back;

/// In words, as diagram and table have it: "operator link lost". Commands by their names.
[[nodiscard]] std::string_view to_string(Event event);
/// That the command is.
[[nodiscard]] Event event_of(Command const& command);
[[nodiscard]] bool is_command(Event event);

}  // namespace lapwing::autonomy
