#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sim/model/kind.hpp"

namespace lapwing::sim {

/// What a mode makes the vehicle do; several modes share one behaviour, since there is no pilot at the sticks.
enum class Behaviour {
  manual,  ///< sticks at rest, throttle low: falls, rolls out, stands
  sink,    ///< a rotorcraft that keeps height by throttle stick sinks with the stick down
  hold,    ///< stays where it is
  circle,
  mission,
  guided,
  return_home,
  retrace,  ///< home along the way that led here
  land,
  take_off,  ///< an aeroplane's automatic take-off
};

/// Who gets into a mode that ArduPilot has. Nobody is at the sticks, throttle low, and the equipment is the plainest.
enum class Entry {
  open,
  disarmed,  ///< only to begin from the ground with
  closed,    ///< it needs a pilot, a sensor or a setting that is not there
};

/// One row of an autopilot's mode table.
struct FlightMode {
  std::string_view name;
  Behaviour behaviour;
  bool armable;
  bool needs_position;
  std::uint8_t base_mode;  ///< HEARTBEAT.base_mode while disarmed
  Entry entry = Entry::open;
  std::string_view lacks = {};  ///< what is said of a closed mode before the refusal
  std::uint32_t number = 0;     ///< HEARTBEAT.custom_mode, as `mavlink::mode_number` knows it
};

/// The modes of a copter, plane, rover, boat or underwater vehicle that this build of the autopilot knows.
[[nodiscard]] std::span<FlightMode const> flight_modes(Kind const& kind);
/// Null when there is no such mode.
[[nodiscard]] FlightMode const* find_mode(Kind const& kind, std::uint32_t number);
/// The first mode with that behaviour. Where there is none: for a return home the one that lands or surfaces, for
/// holding the one that goes where the ground says (PX4's AUTO.LOITER does both), for landing the return (a plane's).
/// Precondition: the family has one.
[[nodiscard]] FlightMode const& mode_for(Kind const& kind, Behaviour behaviour);
/// The mode after power-on.
[[nodiscard]] FlightMode const& initial_mode(Kind const& kind);

}  // namespace lapwing::sim
