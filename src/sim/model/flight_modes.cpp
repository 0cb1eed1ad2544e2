#include "sim/model/flight_modes.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "base/assert.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::sim {

namespace {

using enum Behaviour;
using enum vehicle::Family;

/// Of ArduPilot where a family is given, of PX4 where none is: its modes are the same for all.
std::vector<FlightMode> numbered(vehicle::Family family, std::span<FlightMode const> rows) {
  std::vector<FlightMode> modes(rows.begin(), rows.end());
  auto const autopilot = family == unknown ? vehicle::Autopilot::px4 : vehicle::Autopilot::ardupilot;
  for (auto& mode : modes) {
    auto const number = mavlink::mode_number(autopilot, family, mode.name);
    LAPWING_ASSERT(number.has_value(), mode.name);
    mode.number = *number;
  }
  return modes;
}

// base_mode: custom 0x01, guided 0x08, stabilize 0x10, manual input 0x40. The copter and rover rows were read from
// HEARTBEATs of ArduCopter and ArduRover 4.6; the plane's follow ArduPlane's GCS_Plane::base_mode. FLIP and AUTOTUNE
// want a pilot with throttle, FLOWHOLD an optical flow sensor, SYSTEMID an axis, TURTLE speed controllers that turn
// backwards.
constexpr auto copter_modes = std::to_array<FlightMode>({
    {"STABILIZE", manual, true, false, 0x51},
    {"ACRO", manual, true, false, 0x51},
    {"ALT_HOLD", sink, true, false, 0x51},
    {"AUTO", mission, false, true, 0x59},
    {"GUIDED", guided, true, true, 0x59},
    {"LOITER", sink, true, true, 0x59},
    {"RTL", return_home, false, true, 0x59},
    {"CIRCLE", circle, false, true, 0x59},
    {"LAND", land, false, false, 0x51},
    {"DRIFT", sink, true, true, 0x51},
    {"FLIP", sink, false, false, 0x51, Entry::closed},
    {"AUTOTUNE", sink, false, false, 0x51, Entry::closed},
    {"POSHOLD", sink, true, true, 0x59},
    {"BRAKE", hold, false, true, 0x59},
    {"THROW", manual, true, true, 0x51, Entry::disarmed},
    {"AVOID_ADSB", hold, false, true, 0x59},
    {"GUIDED_NOGPS", manual, true, false, 0x51},
    {"SMART_RTL", retrace, false, true, 0x59},
    {"FLOWHOLD", sink, true, false, 0x51, Entry::closed},
    {"FOLLOW", hold, false, true, 0x59, Entry::closed, "Set FOLL_ENABLE = 1"},
    {"ZIGZAG", sink, true, true, 0x51},
    {"SYSTEMID", manual, false, false, 0x51, Entry::closed, "No axis selected, SID_AXIS = 0"},
    {"AUTO_RTL", return_home, false, true, 0x59},
    {"TURTLE", manual, true, false, 0x51, Entry::closed},
});

constexpr auto rover_modes = std::to_array<FlightMode>({
    {"MANUAL", manual, true, false, 0x41},
    {"ACRO", manual, true, false, 0x51},
    {"STEERING", manual, true, false, 0x51},
    {"HOLD", hold, true, false, 0x01},
    {"LOITER", hold, true, true, 0x09},
    {"FOLLOW", hold, true, true, 0x09},
    {"SIMPLE", manual, true, false, 0x41},
    {"DOCK", hold, false, true, 0x09},
    {"CIRCLE", circle, true, true, 0x09},
    {"AUTO", mission, true, true, 0x09},
    {"RTL", return_home, true, true, 0x09},
    {"SMART_RTL", retrace, true, true, 0x09},
    {"GUIDED", guided, true, true, 0x09},
    {"INITIALISING", manual, false, false, 0x01, Entry::closed},
});

/// Said of the modes of an aeroplane that hovers.
constexpr std::string_view no_rotors = "Q_ENABLE 0";
constexpr auto plane_modes = std::to_array<FlightMode>({
    {"MANUAL", manual, true, false, 0x41},
    {"CIRCLE", circle, true, false, 0x59},
    {"STABILIZE", manual, true, false, 0x51},
    {"TRAINING", manual, true, false, 0x41},
    {"ACRO", manual, true, false, 0x51},
    {"FBWA", manual, true, false, 0x51},
    {"FBWB", manual, true, false, 0x51},
    {"CRUISE", manual, true, false, 0x51},
    {"AUTOTUNE", manual, true, false, 0x51},
    {"AUTO", mission, true, true, 0x59},
    {"RTL", return_home, false, true, 0x59},
    {"LOITER", hold, true, true, 0x59},
    {"TAKEOFF", take_off, true, true, 0x59},
    {"AVOID_ADSB", hold, false, true, 0x59},
    {"GUIDED", guided, true, true, 0x59},
    {"INITIALISING", manual, false, false, 0x11, Entry::closed},
    {"QSTABILIZE", hold, true, false, 0x51, Entry::closed, no_rotors},
    {"QHOVER", hold, true, false, 0x51, Entry::closed, no_rotors},
    {"QLOITER", hold, true, true, 0x51, Entry::closed, no_rotors},
    {"QLAND", hold, false, true, 0x51, Entry::closed, no_rotors},
    {"QRTL", hold, false, true, 0x59, Entry::closed, no_rotors},
    {"QAUTOTUNE", hold, false, false, 0x51, Entry::closed, no_rotors},
    {"QACRO", hold, true, false, 0x51, Entry::closed, no_rotors},
    {"THERMAL", hold, true, true, 0x59, Entry::closed},
});

// ArduSub's numbers; its base modes are the copter's.
constexpr auto sub_modes = std::to_array<FlightMode>({
    {"MANUAL", manual, true, false, 0x51},
    {"STABILIZE", manual, true, false, 0x51},
    {"ACRO", manual, true, false, 0x51},
    {"ALT_HOLD", hold, true, false, 0x51},
    {"AUTO", mission, true, true, 0x59},
    {"GUIDED", guided, true, true, 0x59},
    {"CIRCLE", circle, true, true, 0x59},
    {"SURFACE", land, true, false, 0x51},
    {"POSHOLD", hold, true, true, 0x59},
});

// PX4: the same for every kind of vehicle. The first is where it is after the start without a remote control. Base
// modes as its HEARTBEAT stream makes them of control flags: AUTO 0x04, stabilize and guided in the automatic modes.
constexpr auto px4_modes = std::to_array<FlightMode>({
    {"AUTO.LOITER", guided, true, true, 0x1D},
    {"AUTO.TAKEOFF", take_off, true, true, 0x1D},
    {"AUTO.MISSION", mission, true, true, 0x1D},
    {"AUTO.RTL", return_home, false, true, 0x1D},
    {"AUTO.LAND", land, false, false, 0x1D},
    {"OFFBOARD", guided, true, true, 0x1D},
    {"MANUAL", manual, true, false, 0x51},
    {"ALTCTL", manual, true, false, 0x51},
    {"POSCTL", manual, true, true, 0x51},
    {"ACRO", manual, true, false, 0x41},
    {"STABILIZED", manual, true, false, 0x51},
});

/// The behaviour that stands in for one that a vehicle has no mode for.
Behaviour instead_of(Behaviour behaviour) {
  if (behaviour == hold) return guided;
  return behaviour == land || behaviour == retrace ? return_home : land;
}

}  // namespace

std::span<FlightMode const> flight_modes(Kind const& kind) {
  static auto const of_px4 = numbered(unknown, px4_modes);
  static auto const of_planes = numbered(plane, plane_modes);
  static auto const of_rovers = numbered(rover, rover_modes);
  static auto const of_subs = numbered(sub, sub_modes);
  static auto const of_copters = numbered(copter, copter_modes);
  if (kind.is_px4()) return of_px4;
  if (kind.family == plane) return of_planes;
  if (kind.family == rover || kind.family == boat) return of_rovers;
  if (kind.family == sub) return of_subs;
  return of_copters;
}

FlightMode const* find_mode(Kind const& kind, std::uint32_t number) {
  auto const modes = flight_modes(kind);
  auto const found = std::ranges::find(modes, number, &FlightMode::number);
  return found == modes.end() ? nullptr : &*found;
}

FlightMode const& mode_for(Kind const& kind, Behaviour behaviour) {
  // The rover's HOLD and the plane's LOITER are the first rows that hold; the copter's is BRAKE.
  auto const modes = flight_modes(kind);
  auto const found = std::ranges::find(modes, behaviour, &FlightMode::behaviour);
  return found == modes.end() ? mode_for(kind, instead_of(behaviour)) : *found;
}

FlightMode const& initial_mode(Kind const& kind) {
  return flight_modes(kind).front();
}

}  // namespace lapwing::sim
